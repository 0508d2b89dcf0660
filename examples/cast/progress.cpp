// See progress.h. The bar has a thread of its own, so that work that can't report (reading a file) shows signs of life.
#include "cast/progress.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <unistd.h>

using namespace std::chrono_literals;

Progress::Progress(std::string what, std::uint64_t total) : what_(std::move(what)), total_(total) {
    if (isatty(STDERR_FILENO)) drawer_ = std::thread([this] { draw_until_stopped(); });
}

Progress::~Progress() {
    if (!drawer_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
    }
    wake_.notify_one();
    drawer_.join();
}

void Progress::draw_until_stopped() {
    std::unique_lock lock(mutex_);
    auto wait = 500ms;
    bool drawn = false;
    while (!wake_.wait_for(lock, wait, [this] { return stopped_; })) {
        draw();
        drawn = true;
        wait = 100ms;
    }
    if (drawn) std::fputs("\r\033[K", stderr);
}

void Progress::draw() const {
    constexpr int width = 30;
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    std::string bar(width, '.');
    std::string share = "     ";
    if (total_ > 0) {
        const double part = std::min(1.0, static_cast<double>(done_.load()) / static_cast<double>(total_));
        std::fill_n(bar.begin(), static_cast<int>(part * width), '#');
        share = std::to_string(static_cast<int>(part * 100)) + " %";
    } else {
        // A block that runs through the bar once in three seconds.
        const int place = static_cast<int>(seconds * 10) % width;
        std::fill_n(bar.begin() + place, std::min(3, width - place), '#');
    }
    std::fprintf(stderr, "\r\033[K%s [%s] %5s %.1f s", what_.c_str(), bar.c_str(), share.c_str(), seconds);
}

// See work.h. Messages and no shared counter (MPI_Fetch_and_op): that one is no slower where the network adds to memory
// by itself, but over TCP it waits for rank 0 to call MPI, and what is asked early is not sent early (Open MPI 4.1).
#include "mpi_tracking/work.h"

#include <algorithm>
#include <thread>

namespace tracking {

namespace {

constexpr int k_question = 1, k_answer = 2;
constexpr std::uint64_t k_most_batches = 8;

}  // namespace

Work::Work(const Ranks& ranks, std::uint64_t first, std::uint64_t end, std::uint64_t batch, unsigned threads)
    : ranks_(ranks), batch_(batch), share_(batch * threads), next_(first), end_(end) {}

void Work::begin(double seconds) {
    begin_ = next_;
    until_ = MPI_Wtime() + seconds;
    told_ = 0;
    is_over_ = false;
    if (!ranks_.is_first()) ask();
}

Work::Part Work::take() {
    if (ranks_.is_first()) {
        const std::lock_guard lock(mutex_);
        answer_all();
        return hand_out(batch_);
    }
    for (;; std::this_thread::yield()) {
        const std::lock_guard lock(mutex_);
        if (!has_share()) continue;
        const Part part{mine_.first, std::min(batch_, mine_.count)};
        mine_ = {mine_.first + part.count, mine_.count - part.count};
        return part;
    }
}

void Work::end() {
    if (!ranks_.is_first()) return;
    for (; told_ < ranks_.size() - 1; std::this_thread::yield()) answer_all();
}

Work::Part Work::hand_out(std::uint64_t count) {
    const bool is_late = MPI_Wtime() >= until_ && next_ > begin_;  // however late it is, a round gets on by something
    const Part part{next_, is_late ? 0 : std::min(count, end_ - next_)};
    next_ += part.count;
    return part;
}

void Work::answer_all() {
    for (;;) {
        int is_there = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, k_question, MPI_COMM_WORLD, &is_there, &status);
        if (is_there == 0) return;
        std::uint64_t count = 0;
        MPI_Recv(&count, 1, MPI_UINT64_T, status.MPI_SOURCE, k_question, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        const std::uint64_t even = (end_ - next_) / (4 * static_cast<std::uint64_t>(ranks_.size()));
        const Part part = hand_out(std::clamp(even, count, k_most_batches * count));
        told_ += part.count == 0;
        const std::array<std::uint64_t, 2> words = {part.first, part.count};
        MPI_Send(words.data(), 2, MPI_UINT64_T, status.MPI_SOURCE, k_answer, MPI_COMM_WORLD);
    }
}

void Work::ask() {
    MPI_Irecv(answer_.data(), 2, MPI_UINT64_T, 0, k_answer, MPI_COMM_WORLD, &request_);
    MPI_Send(&share_, 1, MPI_UINT64_T, 0, k_question, MPI_COMM_WORLD);
}

/// Whether there is something in `mine_`, or never will be in this round.
bool Work::has_share() {
    if (mine_.count > 0 || is_over_) return true;
    int is_there = 0;
    MPI_Test(&request_, &is_there, MPI_STATUS_IGNORE);
    if (is_there == 0) return false;
    mine_ = {answer_[0], answer_[1]};
    is_over_ = mine_.count == 0;
    if (!is_over_) ask();
    return true;
}

}  // namespace tracking

// Tables in Markdown, and figures as they stand in them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace pierce::bench {

/// How many of how many.
struct Share {
    std::size_t part = 0;
    std::size_t whole = 0;

    void add(bool counts) {
        ++whole;
        if (counts) ++part;
    }
    void add(const Share& other) {
        part += other.part;
        whole += other.whole;
    }
    [[nodiscard]] bool all() const { return part == whole; }

    /// "0" means none at all, and "100 %" all: never a share that was rounded to it.
    [[nodiscard]] std::string percent() const {
        if (part == 0) return "0";
        if (all()) return "100 %";
        const double share = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
        std::ostringstream out;
        if (share > 99.9)
            out << std::fixed << std::setprecision(4) << share;
        else
            out << std::setprecision(share < 0.1 ? 2 : 3) << share;
        return out.str() + " %";
    }
};

class Table {
  public:
    explicit Table(std::vector<std::string> head) { rows_.push_back(std::move(head)); }

    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

    void print(std::ostream& out) const {
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            out << '|';
            for (std::size_t c = 0; c < rows_[r].size(); ++c)
                out << ' ' << std::setw(width(c)) << std::left << rows_[r][c] << " |";
            out << '\n';
            if (r > 0) continue;
            out << '|';
            for (std::size_t c = 0; c < rows_[0].size(); ++c)
                out << std::string(static_cast<std::size_t>(width(c)) + 2, '-') << '|';
            out << '\n';
        }
        out << std::endl;
    }

  private:
    [[nodiscard]] int width(std::size_t column) const {
        std::size_t widest = 3;
        for (const auto& row : rows_) widest = std::max(widest, row[column].size());
        return static_cast<int>(widest);
    }

    std::vector<std::vector<std::string>> rows_;
};

}  // namespace pierce::bench

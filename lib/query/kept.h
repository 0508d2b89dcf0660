// The first of many answers, where they come in any order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace pierce::detail {

/// The first answers of `out.size()` in an order, of all that come; as a heap, the last of them on top (Williams 1964).
/// `sort` puts them in order, and returns how many came.
template <class Answer, class Before>
class Kept {
  public:
    Kept(std::span<Answer> out, Before before) : out_(out), before_(before) {}
    void add(const Answer& hit) {
        ++total_;
        if (out_.empty()) return;
        if (kept_ == out_.size()) {
            if (!before_(hit, out_[0])) return;
            std::pop_heap(out_.begin(), out_.end(), before_);
            --kept_;
        }
        out_[kept_++] = hit;
        std::push_heap(out_.begin(), end(), before_);
    }
    std::size_t sort() {
        std::sort_heap(out_.begin(), end(), before_);
        return total_;
    }

  private:
    auto end() const { return out_.begin() + static_cast<std::ptrdiff_t>(kept_); }

    std::span<Answer> out_;
    Before before_;
    std::size_t kept_ = 0;
    std::size_t total_ = 0;
};

}  // namespace pierce::detail

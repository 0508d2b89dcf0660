// The triangles that a point or a passage lies on, as the caller gets them.
#pragma once

#include <algorithm>
#include <span>

#include <decision.h>
#include <pierce/location.h>
#include <query/scene.h>

namespace pierce::detail {

[[nodiscard]] inline bool comes_before(const FaceTouch& x, const FaceTouch& y) {
    return x.face != y.face ? x.face < y.face : x.triangle < y.triangle;
}

template <class Scalar>
[[nodiscard]] FaceTouch touch_of(const Scene<Scalar>& scene, TriangleRef triangle, const Decision& decision,
                                 int crossing) {
    const std::uint32_t number = scene.number_of(triangle);
    return {scene.face_of_number(number), number, decision.feature, decision.feature_index,
            static_cast<std::int8_t>(crossing)};
}

/// Counts all and keeps the first ones in `out`, as a heap with the last of them on top (Williams 1964); `sort` puts
/// them in order.
class FirstTouches {
  public:
    explicit FirstTouches(std::span<FaceTouch> out) : out_(out) {}

    void add(const FaceTouch& touch) {
        ++total_;
        if (out_.empty()) return;
        if (kept_ == out_.size()) {
            if (!comes_before(touch, out_[0])) return;
            std::pop_heap(out_.begin(), out_.end(), before);
            out_.back() = touch;
        } else {
            out_[kept_++] = touch;
        }
        std::push_heap(out_.begin(), kept_end(), before);
    }
    void sort() { std::sort_heap(out_.begin(), kept_end(), before); }
    [[nodiscard]] std::size_t total() const { return total_; }

  private:
    static bool before(const FaceTouch& x, const FaceTouch& y) { return comes_before(x, y); }
    [[nodiscard]] std::span<FaceTouch>::iterator kept_end() const {
        return out_.begin() + static_cast<std::ptrdiff_t>(kept_);
    }

    std::span<FaceTouch> out_;
    std::size_t kept_ = 0;
    std::size_t total_ = 0;
};

}  // namespace pierce::detail

// Boxes in scene units to the bounds of a node, outward: each certainly holds what it should.
#pragma once

#include <cstdint>
#include <limits>

#include <cluster/quad.h>
#include <node.h>

namespace pierce::detail {

/// The bounds of child i in steps, rounded towards zero.
template <class Bound>
[[gnu::always_inline]] inline void write_bounds(Bound (&bounds)[6][k_children], unsigned i, const Quad<double>& low,
                                                const Quad<double>& high) {
    const IntQuad l = __builtin_convertvector(low, IntQuad);
    const IntQuad h = __builtin_convertvector(high, IntQuad);
    for (int k = 0; k < 3; ++k) {
        bounds[2 * k][i] = static_cast<Bound>(l[k]);
        bounds[2 * k + 1][i] = static_cast<Bound>(h[k]);
    }
}

/// A place without a child has a low bound above the high one.
template <class Bound>
void close_place(Bound (&bounds)[6][k_children], unsigned i) {
    for (int k = 0; k < 3; ++k) {
        bounds[2 * k][i] = std::numeric_limits<Bound>::max();
        bounds[2 * k + 1][i] = 0;
    }
}
/// Those from `count` on.
template <class Bound>
void close_places(Bound (&bounds)[6][k_children], unsigned count) {
    for (unsigned i = count; i < k_children; ++i) close_place(bounds, i);
}

/// Bounds on the scene's lattice. x - low is within 2^-53 of itself, of at most 65536 steps, so within 2^-37 steps;
/// dividing by a power of two is exact; what scene units lost to underflow (2^-150, 2^-1075) is nothing beside a step
/// where they did (over 2^-18, node.h's Frame:
/// `unit` is below 1 only for scenes wider than 1/2). Taking and adding 2^-30 steps rounds by 2^-37 again and is more
/// than all that.
class Lattice {
  public:
    using Kind = Node;
    static constexpr bool k_coarse = false;

    explicit Lattice(const Frame& frame) : low_{frame.low[0], frame.low[1], frame.low[2], 0}, scale_(1 / frame.step) {}

    template <class Scalar>
    void encode(Node& node, const QuadBox<Scalar>* boxes, unsigned count) const {
        for (unsigned i = 0; i < count; ++i) {
            const Quad<double> low = (__builtin_convertvector(boxes[i].low, Quad<double>) - low_) * scale_ - 0x1p-30;
            const Quad<double> high =
                (__builtin_convertvector(boxes[i].high, Quad<double>) - low_) * scale_ + (1 + 0x1p-30);
            write_bounds(node.bounds, i, low, high);
        }
        close_places(node.bounds, count);
    }

  private:
    Quad<double> low_;
    double scale_;
};

/// Bounds in a frame of the node's own. All that is subtracted is within the scene's extent E of 0, so within 2^-52 E
/// of the exact number, scene units lost to underflow included; `slack` is 2^-48 E. Bounds in steps lose 2^-52 of at
/// most 256 in each of two operations: 2^-40 steps are more.
class OwnFrames {
  public:
    using Kind = CoarseNode;
    static constexpr bool k_coarse = true;

    explicit OwnFrames(const Frame& frame) : low_{frame.low[0], frame.low[1], frame.low[2], 0} {
        const Quad<double> high = {frame.high[0], frame.high[1], frame.high[2], 0};
        slack_ = 0x1p-48 * largest_of<double>(high - low_);
    }

    template <class Scalar>
    void encode(CoarseNode& node, const QuadBox<Scalar>* boxes, unsigned count) const {
        std::memset(node.unused, 0, sizeof node.unused);
        QuadBox<Scalar> all;
        for (unsigned i = 0; i < count; ++i) all.add(boxes[i]);
        const QuadBox<double> whole = relative(all);
        const Quad<double> origin = whole.low - slack_;
        // 254 of 255 steps: what rounding to float takes from a step, and to double from the rest, is far below 1 / 255
        // of it.
        const Quad<double> extent = (whole.high + slack_ - origin) / 254.0;
        Quad<double> step = all_of(1.0);
        for (int k = 0; k < 3; ++k) {
            node.origin[k] = origin[k];
            node.step[k] = static_cast<float>(extent[k]);
            step[k] = static_cast<double>(node.step[k]);
        }
        for (unsigned i = 0; i < count; ++i) {
            const QuadBox<double> box = relative(boxes[i]);
            const Quad<double> low = most((box.low - origin) / step - 0x1p-40, Quad<double>{});
            const Quad<double> high = (box.high - origin) / step + (1 + 0x1p-40);
            write_bounds(node.bounds, i, low, high);
        }
        close_places(node.bounds, count);
    }

  private:
    // Relative to the lattice's low end, with half the slack around it.
    template <class Scalar>
    [[nodiscard]] QuadBox<double> relative(const QuadBox<Scalar>& box) const {
        return {__builtin_convertvector(box.low, Quad<double>) - low_ - slack_ / 2,
                __builtin_convertvector(box.high, Quad<double>) - low_ + slack_ / 2};
    }

    Quad<double> low_;
    double slack_;
};

}  // namespace pierce::detail

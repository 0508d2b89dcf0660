// Boxes as bounds of a node, rounded outward: each decoded box holds all of the child, in exact arithmetic.
#pragma once

#include <algorithm>
#include <cmath>

#include <node.h>
#include <vector4.h>

namespace pierce::detail {

/// A child's box relative to Frame::low, in double. The difference of two numbers below 2 is within 2^-52 of the exact one (of two floats mostly exact).
struct EncodedBox {
    double low[3];
    double high[3];
    std::uint32_t child;
};
constexpr double k_encoding_slack = 0x1p-51;

template <class Scalar>
[[nodiscard]] EncodedBox relative_box(const Box4<Scalar>& box, const Frame& frame, std::uint32_t child) {
    EncodedBox out;
    for (int k = 0; k < 3; ++k) {
        out.low[k] = static_cast<double>(box.low[k]) - frame.low[k] - k_encoding_slack;
        out.high[k] = static_cast<double>(box.high[k]) - frame.low[k] + k_encoding_slack;
    }
    out.child = child;
    return out;
}

/// Steps are powers of two: quotients are exact. The frame leaves two steps on each side, so nothing is cut off.
inline void encode(const EncodedBox* boxes, unsigned count, std::uint32_t empty, const Frame& frame, Node& node) {
    for (unsigned i = 0; i < k_children; ++i) {
        node.child[i] = i < count ? boxes[i].child : empty;
        for (int k = 0; k < 3; ++k) {
            node.bounds[2 * k][i] = 65535;
            node.bounds[2 * k + 1][i] = 0;
            if (i >= count) continue;
            node.bounds[2 * k][i] = static_cast<std::uint16_t>(std::clamp(std::floor(boxes[i].low[k] / frame.step), 0.0, 65535.0));
            node.bounds[2 * k + 1][i] = static_cast<std::uint16_t>(std::clamp(std::ceil(boxes[i].high[k] / frame.step), 0.0, 65535.0));
        }
    }
}

/// A bound b stands for origin + b * step, where the product is exact and the sum within 2^-52: one slack more. Quotients round to within 2^-45 of
/// themselves below 255: a thousandth is more than enough.
inline void encode(const EncodedBox* boxes, unsigned count, std::uint32_t empty, const Frame&, CoarseNode& node) {
    for (int k = 0; k < 3; ++k) {
        double low = boxes[0].low[k];
        double high = boxes[0].high[k];
        for (unsigned i = 1; i < count; ++i) {
            low = std::min(low, boxes[i].low[k]);
            high = std::max(high, boxes[i].high[k]);
        }
        node.origin[k] = low - k_encoding_slack;
        const auto step = static_cast<float>((high - low + 4 * k_encoding_slack) / 254 * (1 + 0x1p-20));
        node.step[k] = step;
        for (unsigned i = 0; i < k_children; ++i) {
            node.bounds[2 * k][i] = 255;
            node.bounds[2 * k + 1][i] = 0;
            if (i >= count) continue;
            const double from = (boxes[i].low[k] - k_encoding_slack - node.origin[k]) / static_cast<double>(step) - 0.001;
            const double to = (boxes[i].high[k] + k_encoding_slack - node.origin[k]) / static_cast<double>(step) + 0.001;
            node.bounds[2 * k][i] = static_cast<std::uint8_t>(std::clamp(std::floor(from), 0.0, 255.0));
            node.bounds[2 * k + 1][i] = static_cast<std::uint8_t>(std::clamp(std::ceil(to), 0.0, 255.0));
        }
    }
    for (unsigned i = 0; i < k_children; ++i) node.child[i] = i < count ? boxes[i].child : empty;
    std::fill(std::begin(node.unused), std::end(node.unused), 0U);
}

}  // namespace pierce::detail

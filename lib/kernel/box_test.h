// Which children of a node does the box around a short segment touch? In whole numbers on the scene's lattice, sixteen
// at a time: a third of what the slab test takes (slab_test.h), and for a segment no longer than clusters are wide
// nearly as exact.
//
// Where the segment comes within the probe's noise of a child, in each coordinate, some x of it and some b of the
// child's box have |x - b| <= noise, so with the segment's least and largest coordinates
//   low of the child <= largest + noise   and   high of the child >= least - noise.
// The child's bounds in steps are whole numbers outside of its own, so the first is kept by rounding its right side
// down, the second by rounding its right side down as well. set_probe() takes the noise twice: it is at least 2^-51 of
// the coordinates' sizes, and least and largest, the sums, and their quotients by the step, a power of two, lose 2^-53
// of them each time. What is beyond 0 or 65535 is set to these, which only makes the box larger where bounds are: they
// are between.
#pragma once

#include <kernel/probe.h>
#include <node.h>

namespace pierce::detail {

/// Of a probe, each number in all words of a register.
template <class Wide>
struct Box {
    typename Wide::Words low[3];
    typename Wide::Words high[3];

    Box() = default;
    template <class Scalar>
    [[gnu::always_inline]] explicit Box(const Probe<Scalar>& probe) {
        for (unsigned k = 0; k < 3; ++k) {
            low[k] = Wide::all_words(probe.low[k]);
            high[k] = Wide::all_words(probe.high[k]);
        }
    }
};

/// A bit for each child that is touched. A place without a child has a low bound of 65535 and a high one of 0.
template <class Wide>
[[gnu::always_inline]] inline unsigned box_test(const Node& node, const Box<Wide>& box) {
    unsigned bits = 0;
    for (unsigned first = 0; first < k_children; first += Wide::words_width) {
        typename Wide::Words off = Wide::above(Wide::load_words(node.bounds[0] + first), box.high[0]);
        for (unsigned k = 0; k < 3; ++k) {
            if (k > 0) off = Wide::either(off, Wide::above(Wide::load_words(node.bounds[2 * k] + first), box.high[k]));
            off = Wide::either(off, Wide::above(box.low[k], Wide::load_words(node.bounds[2 * k + 1] + first)));
        }
        bits |= Wide::zeros(off) << first;
    }
    return bits;
}

}  // namespace pierce::detail

// Many short segments at once, step by step: what one waits for is asked of memory while the others take theirs, and few branches depend on
// which of them it is. The same functions as for one (block.h, lanes.h), so what is found is the same.
//
// As lanes.h: for any instruction set, included by backend_*.cpp, with nothing that other files could share.
#pragma once

#include <kernel/block.h>

namespace pierce::detail {

namespace {

using Long4 [[gnu::vector_size(32)]] = long long;

constexpr Node k_no_node;

/// Whether all of some numbers are: x - x is 0 for a number and NaN for what is none.
template <class Wide>
[[gnu::always_inline]] inline bool are_finite(const Double4& from, const Double4& to) {
    const Double4 zero = {0, 0, 0, 0};
    const Long4 not_zero = (from - from) + (to - to) != zero;
    return Wide::negative(__builtin_convertvector(not_zero, Int4)) == 0;
}

}  // namespace

// query/search.h, set_ray, operation for operation.
template <class Wide, class Scalar>
[[gnu::always_inline]] inline void set_ray(const Scalar* start, const Scalar* finish, float scale, Ray<Scalar>& ray) {
    using Float4 [[gnu::vector_size(16)]] = float;
    constexpr bool single = sizeof(Scalar) == sizeof(float);
    constexpr double least = single ? 0x1p-126 : 0x1p-1022;
    constexpr double unit = single ? 0x1p-50 + 0x1p-24 : 0x1p-50 + 0x1p-53;
    Double4 from;
    Double4 to;
    read(start, from);
    read(finish, to);
    Float4 direction = __builtin_convertvector((to - from) * double{scale}, Float4);
    Double4 furthest = from;
    Wide::raise(furthest, -from);
    Wide::raise(furthest, to);
    Wide::raise(furthest, -to);
    double most = least;
    for (int k = 0; k < 3; ++k) {
        most = furthest[k] > most ? furthest[k] : most;
        ray.origin[k] = start[k];
    }
    ray.origin[3] = 0;
    direction[3] = static_cast<float>(most * unit * (double{scale} * 2.0002));
    __builtin_memcpy(ray.direction, &direction, sizeof direction);
}

/// See ScalarKernels::find.
template <class Wide, class Scalar>
[[gnu::always_inline]] inline unsigned find(const PackedLevel& level_, const Ends<Scalar>& ends, std::size_t first, unsigned count,
                                            float scale, Stop* out, Look* looks, Ray<Scalar>* rays) {
    const PackedLevel level = level_;  // so that it stays in registers: nothing that is written here can be a part of it
    Reach reaches[k_group];
    const Node* roots[k_group];  // null: of more than one brick; k_no_node: of none
    for (unsigned i = 0; i < count; ++i) {
        const auto at = static_cast<std::ptrdiff_t>(first + i);
        Double4 from;
        Double4 to;
        read(ends.from + at * ends.from_stride, from);
        read(ends.to + at * ends.to_stride, to);
        Reach& reach = reaches[i];
        roots[i] = &k_no_node;
        if (!are_finite<Wide>(from, to)) {
            looks[i] = Look::invalid;
            continue;
        }
        if (!reach_of<Wide>(level, from, to, reach)) continue;
        const Int4 brick = reach.first_step >> (k_step_bits + 2);
        const Int4 last_brick = reach.last_step >> (k_step_bits + 2);
        const Node* root = root_of(level, brick);
        __builtin_prefetch(root);
        roots[i] = Wide::negative(brick - last_brick) == 0 ? root : nullptr;
    }
    unsigned found = 0;
    for (unsigned i = 0; i < count; ++i) {
        if (roots[i] == &k_no_node) continue;
        First look = {nullptr, 0};
        if (roots[i] != nullptr) {  // nearly always
            look.brick = roots[i];
            const Int4 brick = reaches[i].first_step >> (k_step_bits + 2);
            if (level.root_shift > 2) look.brick = brick_under<Wide>(level, look.brick, brick);
            if (look.brick == nullptr) continue;
            look.cells = cells_in_brick(*look.brick, brick << 2, reaches[i]);
            if (look.cells == 0) continue;
        }
        Stop* stops = out + found;
        const int some = stops_of<Wide>(level, reaches[i], look, stops);
        if (some < 0) looks[i] = Look::alone;
        if (some <= 0) continue;
        for (int s = 0; s < some; ++s) {
            stops[s].query = i;
            __builtin_prefetch(level.starts + stops[s].number);
        }
        found += static_cast<unsigned>(some);
        const auto at = static_cast<std::ptrdiff_t>(first + i);
        set_ray<Wide>(ends.from + at * ends.from_stride, ends.to + at * ends.to_stride, scale, rays[i]);
    }
    return found;
}

/// See Backend::cull_many.
template <class Wide>
[[gnu::always_inline]] inline unsigned cull_many(const Boxes* cells, unsigned count, const void* corners, std::size_t bytes,
                                                 std::uint32_t* ids, std::uint32_t* queries) {
    unsigned left = 0;
    unsigned asked = 0;
    for (unsigned c = 0; c < count; ++c) {
        const Boxes* cell = cells + c;
        const Int4 query = Int4{0, 0, 0, 0} + static_cast<int>(cell->query);
        const unsigned some = cull<Wide>(cell->boxes, cell->ids, cell->count, cell->cull.above, cell->cull.seen, ids + left);
        for (unsigned i = 0; i < 8; i += 4) __builtin_memcpy(queries + left + i, &query, sizeof query);
        for (unsigned i = 8; i < some; i += 4) __builtin_memcpy(queries + left + i, &query, sizeof query);  // mostly none
        left += some;
        // Now and then: for each cell, the end of the loop would not be foreseen; for all together, memory would get too much at once.
        if (c % 4 != 3 && c + 1 != count) continue;
        for (; asked < left; ++asked) {
            const char* triangle = static_cast<const char*>(corners) + bytes * ids[asked];
            __builtin_prefetch(triangle);
            __builtin_prefetch(triangle + bytes - 1);
        }
    }
    return left;
}

/// The directions of some rays, a lane for each, and the fourth number of each (backend.h, Ray).
template <class Wide>
[[gnu::always_inline]] inline typename Wide::Float directions(const float* const* at, Lanes<Wide>& d) {
    if constexpr (Wide::rows == 1) {
        d = {at[0][0], at[0][1], at[0][2]};
        return at[0][3];
    } else {
        const auto r0 = Wide::row(at, 0);
        const auto r1 = Wide::row(at, 1);
        const auto r2 = Wide::row(at, 2);
        const auto r3 = Wide::row(at, 3);
        d = Wide::columns(r0, r1, r2, r3);
        return Wide::fourth(r0, r1, r2, r3);
    }
}

/// See ScalarKernels::refine_many.
template <class Wide, class Scalar>
[[gnu::always_inline]] inline unsigned refine_many(const Probe<Scalar>& probe, const Ray<Scalar>* rays, const Scalar* corners,
                                                   std::uint32_t* ids, std::uint32_t* queries, unsigned count, std::uint32_t* out) {
    unsigned left = 0;
    fill_lanes<Wide>(ids, count);
    fill_lanes<Wide>(queries, count);
    for (unsigned first = 0; first < count; first += Wide::width) {
        const Scalar* origins[Wide::width];
        const float* ways[Wide::width];
        for (unsigned i = 0; i < Wide::width; ++i) {
            const Ray<Scalar>& ray = rays[queries[first + i]];
            origins[i] = ray.origin;
            ways[i] = ray.direction;
        }
        decltype(Wide::row(origins, 0)) origin[Wide::rows];
        for (unsigned i = 0; i < Wide::rows; ++i) origin[i] = Wide::row(origins, i);
        Lanes<Wide> d;
        const auto noise = directions<Wide>(ways, d);
        const unsigned here = count - first < Wide::width ? count - first : Wide::width;
        for (unsigned some = may_hit<Wide>(probe, d, noise, origin, corners, ids + first, here); some != 0; some &= some - 1)
            out[left++] = first + static_cast<unsigned>(__builtin_ctz(some));
    }
    return left;
}

}  // namespace pierce::detail

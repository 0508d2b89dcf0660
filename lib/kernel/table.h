// The kernels of an instruction set, as the table of functions that queries call.
//
// As lanes.h: included by backend_*.cpp, with nothing that other files could share.
#pragma once

#include <kernel/backends.h>
#include <kernel/many.h>
#include <kernel/walk.h>

namespace pierce::detail {

/// `Wide` for boxes, `Many` for triangles; `Few` for up to its own width of these: fewer loads for the usual few.
template <class Wide, class Many = Wide, class Few = Many>
struct Kernels {
    static int look(const PackedLevel& level, const double* from, const double* to, std::uint32_t* out, unsigned room,
                    unsigned* cells) {
        return detail::look<Wide>(level, from, to, out, room, cells);
    }
    static Walking start_walk(const PackedLevel& level, const double* from, const double* to, double limit, bool once, Walk& walk) {
        return detail::start_walk<Wide>(level, from, to, limit, once, walk);
    }
    static unsigned walk(const PackedLevel& level, Walk& walk, double limit, Stop* stops, unsigned room) {
        return walk_on<Wide>(level, walk, limit, stops, room);
    }
    static unsigned cull(const std::uint64_t* boxes, const std::uint32_t* ids, unsigned count, std::uint64_t above, std::uint64_t seen,
                         std::uint32_t* out) {
        return detail::cull<Wide>(boxes, ids, count, above, seen, out);
    }
    static unsigned cull_many(const Boxes* cells, unsigned count, const void* corners, std::size_t bytes, std::uint32_t* ids,
                              std::uint32_t* queries) {
        return detail::cull_many<Wide>(cells, count, corners, bytes, ids, queries);
    }
    template <class Scalar>
    static unsigned find(const PackedLevel& level, const Ends<Scalar>& ends, std::size_t first, unsigned count, float scale, Stop* out,
                         Look* looks, Ray<Scalar>* rays) {
        return detail::find<Wide>(level, ends, first, count, scale, out, looks, rays);
    }
    template <class Scalar>
    static unsigned refine_many(const Probe<Scalar>& probe, const Ray<Scalar>* rays, const Scalar* corners, std::uint32_t* ids,
                                std::uint32_t* queries, unsigned count, std::uint32_t* out) {
        return detail::refine_many<Many>(probe, rays, corners, ids, queries, count, out);
    }
    template <class Scalar>
    static unsigned refine(const Probe<Scalar>& probe, const Scalar* corners, std::uint32_t* ids, unsigned count, std::uint32_t* out) {
        if (count <= Few::width) return detail::refine<Few>(probe, corners, ids, count, out);
        return detail::refine<Many>(probe, corners, ids, count, out);
    }

    static constexpr Backend named(const char* name) {
        return {name, look, start_walk, walk, cull, cull_many, {find<float>, refine<float>, refine_many<float>},
                {find<double>, refine<double>, refine_many<double>}};
    }
};

}  // namespace pierce::detail

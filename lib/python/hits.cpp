// Hits of segments and rays: the first ones, all of them, whether there are any; and how often each crosses.
#include <algorithm>
#include <span>
#include <vector>

#include <python/arrays.h>
#include <python/bind.h>
#include <python/columns.h>
#include <python/options.h>
#include <python/work.h>

namespace pierce::python {

namespace {

/// Segments, as the calls below are written over them.
template <class Scalar>
struct GivenSegments {
    Pairs<Scalar> ends;

    GivenSegments(const char* call, const py::object& starts, const py::object& to, const py::object&)
        : ends(pairs_of<Scalar>(call, starts, "starts", to, "ends")) {}
    [[nodiscard]] Segments<Scalar> part(std::size_t first, std::size_t count) const {
        return ends.segments(first, count);
    }
    [[nodiscard]] std::size_t size() const { return ends.size; }
};

/// Rays, in the same way.
template <class Scalar>
struct GivenRays {
    Pairs<Scalar> rays;
    Values<Scalar> limits;

    GivenRays(const char* call, const py::object& origins, const py::object& directions, const py::object& limit)
        : rays(pairs_of<Scalar>(call, origins, "origins", directions, "directions")),
          limits(values_of<Scalar>(limit, "limit", rays.size)) {}
    [[nodiscard]] Rays<Scalar> part(std::size_t first, std::size_t count) const {
        const auto origins = rays.firsts(first, count);
        const auto directions = rays.seconds(first, count);
        if (limits.many()) return {origins, directions, limits.first + first};
        return {origins, directions, limits.one};
    }
    [[nodiscard]] std::size_t size() const { return rays.size; }
};

template <template <class> class Given>
py::dict first_hits(const Mesh& self, const py::object& from, const py::object& to, const py::object& limit,
                    const py::object& sides, double max_fraction, const py::object& mask, const py::object& wanted,
                    int threads, const py::object& progress) {
    return self.ask([&](const auto& mesh) {
        using Scalar = ScalarOf<decltype(mesh)>;
        const Given<Scalar> ways("first_hits", from, to, limit);
        const Filters filters(sides, max_fraction, mask, self.flags());
        const HitColumns<Scalar> out(ways.size(), wanted);
        in_calls(ways.size(), {Threads(threads), progress},
                 [&](std::size_t first, std::size_t count, const Executor& executor) {
                     mesh.first_hits(ways.part(first, count), out.part(first, count), filters.options, executor);
                 });
        return out.columns;
    });
}

template <template <class> class Given>
py::array any_hits(const Mesh& self, const py::object& from, const py::object& to, const py::object& limit,
                   const py::object& sides, double max_fraction, const py::object& mask, int threads,
                   const py::object& progress) {
    return self.ask([&](const auto& mesh) {
        using Scalar = ScalarOf<decltype(mesh)>;
        const Given<Scalar> ways("any_hits", from, to, limit);
        const Filters filters(sides, max_fraction, mask, self.flags());
        py::array_t<bool> answers = new_array<bool>(ways.size());
        const std::span<std::uint8_t> out(bytes_of(answers), ways.size());
        in_calls(ways.size(), {Threads(threads), progress},
                 [&](std::size_t first, std::size_t count, const Executor& executor) {
                     mesh.any_hits(ways.part(first, count), out.subspan(first, count), filters.options, executor);
                 });
        return answers;
    });
}

template <class Scalar>
Gathered<Hit<Scalar>> columns_of_hits(std::size_t size, const Wanted& wanted) {
    Gathered<Hit<Scalar>> out(size, &wanted);
    using H = Hit<Scalar>;
    out.template column<Scalar>("fraction", [](const H& hit) { return hit.fraction; });
    out.template column<Scalar>("exact_fraction", [](const H& hit) { return hit.exact_fraction; });
    out.template vectors<Scalar>("point", [](const H& hit) { return hit.point; });
    out.template vectors<Scalar>("position", [](const H& hit) { return hit.position; });
    out.template vectors<Scalar>("normal", [](const H& hit) { return hit.normal; });
    out.template vectors<Scalar>("barycentric", [](const H& hit) { return hit.barycentric; });
    out.face();
    out.feature();
    return out;
}

// Counts all, makes room, and asks again: the second time it is known how many hits each call has.
template <template <class> class Given>
py::tuple all_hits(const Mesh& self, const py::object& from, const py::object& to, const py::object& limit,
                   const py::object& sides, double max_fraction, const py::object& mask, const py::object& wanted,
                   int threads, const py::object& progress) {
    return self.ask([&](const auto& mesh) -> py::tuple {
        using Scalar = ScalarOf<decltype(mesh)>;
        const Given<Scalar> ways("all_hits", from, to, limit);
        const Filters filters(sides, max_fraction, mask, self.flags());
        const Wanted wants(wanted, HitColumns<Scalar>::k_names);
        py::array_t<std::int64_t> offsets = new_array<std::int64_t>(ways.size() + 1);
        std::int64_t* const starts = offsets.mutable_data();
        starts[0] = 0;
        std::vector<std::size_t> rows;
        in_calls(ways.size(), {Threads(threads), py::none()},
                 [&](std::size_t first, std::size_t count, const Executor& executor) {
                     rows.resize(count + 1);
                     mesh.all_hits(ways.part(first, count), rows, {}, filters.options, executor);
                     for (std::size_t i = 1; i <= count; ++i)
                         starts[first + i] = starts[first] + static_cast<std::int64_t>(rows[i]);
                 });
        const auto total = static_cast<std::size_t>(starts[ways.size()]);
        const auto out = columns_of_hits<Scalar>(total, wants);
        py::array_t<bool> hit = new_array<bool>(total);
        std::fill_n(hit.mutable_data(), total, true);
        std::vector<Hit<Scalar>> hits;
        in_calls(ways.size(), {Threads(threads), progress},
                 [&](std::size_t first, std::size_t count, const Executor& executor) {
                     rows.resize(count + 1);
                     hits.resize(static_cast<std::size_t>(starts[first + count] - starts[first]));
                     mesh.all_hits(ways.part(first, count), rows, hits, filters.options, executor);
                     out.write(static_cast<std::size_t>(starts[first]), hits);
                 });
        py::dict columns;
        columns["hit"] = hit;
        columns.attr("update")(out.columns);
        return py::make_tuple(offsets, columns);
    });
}

template <template <class> class Given>
py::array crossings(const Mesh& self, const py::object& from, const py::object& to, const py::object& limit,
                    int threads, const py::object& progress) {
    return self.ask([&](const auto& mesh) {
        using Scalar = ScalarOf<decltype(mesh)>;
        const Given<Scalar> ways("crossings", from, to, limit);
        py::array_t<int> answers = new_array<int>(ways.size());
        const std::span<int> out(answers.mutable_data(), ways.size());
        in_calls(ways.size(), {Threads(threads), progress},
                 [&](std::size_t first, std::size_t count, const Executor& executor) {
                     mesh.crossings(ways.part(first, count), out.subspan(first, count), nullptr, executor);
                 });
        return answers;
    });
}

}  // namespace

void bind_hits(MeshClass& mesh) {
    mesh.def("first_hits", &first_hits<GivenSegments>)
        .def("first_hits_of_rays", &first_hits<GivenRays>)
        .def("any_hits", &any_hits<GivenSegments>)
        .def("any_hits_of_rays", &any_hits<GivenRays>)
        .def("all_hits", &all_hits<GivenSegments>)
        .def("all_hits_of_rays", &all_hits<GivenRays>)
        .def("crossings", &crossings<GivenSegments>)
        .def("crossings_of_rays", &crossings<GivenRays>);
}

}  // namespace pierce::python

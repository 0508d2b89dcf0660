// Where points are, and where segments pass through the surface.
#include <span>
#include <utility>
#include <vector>

#include <python/arrays.h>
#include <python/bind.h>
#include <python/columns.h>
#include <python/options.h>
#include <python/work.h>

namespace pierce::python {

namespace {

py::array contains(const Mesh& self, const py::object& given, int threads, const py::object& progress) {
    return self.ask([&](const auto& mesh) {
        using Scalar = ScalarOf<decltype(mesh)>;
        const Points<Scalar> points = points_of<Scalar>(given, "points");
        const std::size_t size = points.view.size();
        py::array_t<bool> answers = new_array<bool>(size);
        const std::span<std::uint8_t> out(bytes_of(answers), size);
        in_calls(size, {Threads(threads), progress},
                 [&](std::size_t first, std::size_t count, const Executor& executor) {
                     mesh.contains_points(points.view.part(first, count), out.subspan(first, count), nullptr, executor);
                 });
        return answers;
    });
}

py::array winding_numbers(const Mesh& self, const py::object& given, int threads, const py::object& progress) {
    return self.ask([&](const auto& mesh) {
        using Scalar = ScalarOf<decltype(mesh)>;
        const Points<Scalar> points = points_of<Scalar>(given, "points");
        const std::size_t size = points.view.size();
        py::array_t<int> answers = new_array<int>(size);
        const std::span<int> out(answers.mutable_data(), size);
        in_calls(size, {Threads(threads), progress},
                 [&](std::size_t first, std::size_t count, const Executor& executor) {
                     mesh.winding_numbers(points.view.part(first, count), out.subspan(first, count), nullptr, executor);
                 });
        return answers;
    });
}

Gathered<FaceTouch> columns_of_touches(std::size_t size) {
    Gathered<FaceTouch> out(size);
    out.column<std::uint32_t>("face", [](const FaceTouch& touch) { return touch.face; });
    out.column<std::uint32_t>("triangle", [](const FaceTouch& touch) { return touch.triangle; });
    out.column<std::uint8_t>("feature", [](const FaceTouch& touch) { return touch.feature; });
    out.column<std::uint8_t>("feature_index", [](const FaceTouch& touch) { return touch.feature_index; });
    out.column<std::int8_t>("crossing", [](const FaceTouch& touch) { return touch.crossing; });
    return out;
}

// The faces of points on the surface, which are few as a rule, are asked for one point after the other.
py::tuple locate(const Mesh& self, const py::object& given, int threads, const py::object& progress) {
    return self.ask([&](const auto& mesh) -> py::tuple {
        using Scalar = ScalarOf<decltype(mesh)>;
        const Points<Scalar> points = points_of<Scalar>(given, "points");
        const std::size_t size = points.view.size();
        Gathered<Location> out(size);
        out.column<std::uint8_t>("place", [](const Location& one) { return one.place; });
        out.column<std::int32_t>("winding_number", [](const Location& one) { return one.winding_number; });
        out.column<std::int64_t>("face_count", [](const Location& one) { return one.face_count; });
        py::array_t<std::int64_t> firsts = new_array<std::int64_t>(size);
        std::int64_t* const first_faces = firsts.mutable_data();
        std::vector<std::pair<std::size_t, std::size_t>> touching;  // points, and where their faces go
        std::size_t faces = 0;
        std::vector<Location> locations;
        in_calls(size, {Threads(threads), progress},
                 [&](std::size_t first, std::size_t count, const Executor& executor) {
                     locations.resize(count);
                     mesh.locate_points(points.view.part(first, count), locations, nullptr, executor);
                     out.write(first, locations);
                     for (std::size_t i = 0; i < count; ++i) {
                         first_faces[first + i] = static_cast<std::int64_t>(faces);
                         if (locations[i].face_count != 0) touching.emplace_back(first + i, faces);
                         faces += locations[i].face_count;
                     }
                 });
        std::vector<FaceTouch> touches(faces);
        in_calls(touching.size(), {Threads(threads), py::none()},
                 [&](std::size_t first, std::size_t count, const Executor&) {
                     for (std::size_t i = first; i < first + count; ++i)
                         (void)mesh.locate(points.view[touching[i].first],
                                           std::span(touches).subspan(touching[i].second));
                 });
        const auto columns = columns_of_touches(faces);
        columns.write(0, touches);
        out.columns["first_face"] = firsts;
        return py::make_tuple(out.columns, columns.columns);
    });
}

// Passages and faces are counted first.
py::tuple passages(const Mesh& self, const py::object& start, const py::object& end, const py::object& sides,
                   double max_fraction, const py::object& mask) {
    return self.ask([&](const auto& mesh) -> py::tuple {
        using Scalar = ScalarOf<decltype(mesh)>;
        const auto ends = pairs_of<Scalar>("passages", start, "start", end, "end");
        if (ends.size != 1) throw py::value_error("passages: one segment at a time, start and end of shape (3,)");
        const Filters filters(sides, max_fraction, mask, self.flags());
        PassageOptions options;
        options.sides = filters.options.sides;
        options.max_fraction = max_fraction;
        options.face_mask = filters.options.face_mask;
        std::vector<Passage<Scalar>> passages;
        std::vector<FaceTouch> touches;
        {
            const py::gil_scoped_release released;
            const Segment<Scalar> segment{ends.firsts(0, 1)[0], ends.seconds(0, 1)[0]};
            passages.resize(mesh.passages(segment, {}, options));
            mesh.passages(segment, passages, options);
            std::size_t faces = 0;
            for (const auto& passage : passages) faces += passage.face_count;
            touches.resize(faces);
            mesh.passages(segment, passages, options, touches);
        }
        using P = Passage<Scalar>;
        Gathered<P> out(passages.size());
        out.template column<Scalar>("fraction", [](const P& one) { return one.fraction; });
        out.template vectors<Scalar>("position", [](const P& one) { return one.position; });
        out.template vectors<Scalar>("normal", [](const P& one) { return one.normal; });
        out.face();
        out.template column<std::int32_t>("crossings", [](const P& one) { return one.crossings; });
        out.template column<std::uint8_t>("kind", [](const P& one) { return one.kind; });
        out.feature();
        out.template column<bool>("at_end", [](const P& one) { return one.at_end; });
        out.template column<std::int64_t>("first_face", [](const P& one) { return one.first_face; });
        out.template column<std::int64_t>("face_count", [](const P& one) { return one.face_count; });
        out.write(0, passages);
        const auto columns = columns_of_touches(touches.size());
        columns.write(0, touches);
        return py::make_tuple(out.columns, columns.columns);
    });
}

}  // namespace

void bind_places(MeshClass& mesh) {
    mesh.def("contains", &contains).def("winding_numbers", &winding_numbers);
    mesh.def("locate", &locate).def("passages", &passages);
}

}  // namespace pierce::python

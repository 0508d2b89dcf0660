// Faces become triangles, and triangles remember their face once there is a polygon among them.
#include "mesh/read_soup_builder.h"

#include <numeric>
#include <string>
#include <utility>

#include "mesh/read_polygon.h"

namespace pierce::detail {

template <class Scalar>
void SoupBuilder<Scalar>::add_face(std::span<const std::uint32_t> corners) {
    auto& triangles = soup_.triangles;
    auto& faces = soup_.faces;
    const std::size_t cut = corners.size() - 2;
    if (triangles.size() + cut > most_) {
        fail_too_many("triangles");
    }
    if (cut > 1) {
        if (faces.empty()) {  // all faces so far were triangles, each its own face
            faces.resize(triangles.size());
            std::iota(faces.begin(), faces.end(), 0U);
        }
        polygons_.push_back({static_cast<std::uint32_t>(triangles.size()), static_cast<std::uint32_t>(cut)});
    }
    if (!polygons_.empty()) {
        faces.insert(faces.end(), cut, faces.empty() ? 0U : faces.back() + 1);
    }
    if (options_.materials) {
        soup_.material_of_face.push_back(materials_.selected());
    }
    if (options_.groups) {
        soup_.group_of_face.push_back(groups_.selected());
    }
    for (std::size_t i = 2; i < corners.size(); ++i) {
        triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
}

template <class Scalar>
TriangleSoup<Scalar> SoupBuilder<Scalar>::finish() {
    if (soup_.triangles.empty()) {
        file_.fail("holds no face");
    }
    PolygonCutter<Scalar> cutter(soup_.positions);
    for (const Polygon& polygon : polygons_) {
        cutter.cut(std::span(soup_.triangles).subspan(polygon.first_triangle, polygon.triangles));
    }
    soup_.materials = materials_.take_names();
    soup_.groups = groups_.take_names();
    return std::move(soup_);
}

template <class Scalar>
void SoupBuilder<Scalar>::fail_too_many(const char* what) const {
    file_.fail("holds more than " + std::to_string(most_) + " " + what);
}

template class SoupBuilder<float>;
template class SoupBuilder<double>;

}  // namespace pierce::detail

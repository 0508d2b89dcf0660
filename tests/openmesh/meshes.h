// What the OpenMesh tests are made of: a mesh type for any point type, and meshes with small integer coordinates, which
// every point type can hold.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
// Specializes vector_traits, which it does not include: it has to come second.
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>

#include <pierce/openmesh.h>
#include <pierce/pierce.h>

namespace pierce::test {

/// A vector as somebody else would write it: no more operators than OpenMesh asks for, and an index of type int.
struct OwnVector {
    using vector_type = OwnVector;
    using value_type = double;
    static constexpr std::size_t size_ = 3;

    double x = 0;
    double y = 0;
    double z = 0;

    OwnVector() = default;
    OwnVector(double own_x, double own_y, double own_z) : x(own_x), y(own_y), z(own_z) {}
    double& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
    double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
    friend OwnVector operator+(const OwnVector& u, const OwnVector& v) { return {u.x + v.x, u.y + v.y, u.z + v.z}; }
    friend OwnVector operator-(const OwnVector& u, const OwnVector& v) { return {u.x - v.x, u.y - v.y, u.z - v.z}; }
    friend OwnVector operator*(const OwnVector& u, double s) { return {u.x * s, u.y * s, u.z * s}; }
    OwnVector& operator+=(const OwnVector& v) { return *this = *this + v; }
    OwnVector& operator-=(const OwnVector& v) { return *this = *this - v; }
    OwnVector& operator*=(double s) { return *this = *this * s; }
    OwnVector& operator/=(double s) { return *this = *this * (1 / s); }
};

inline double dot(const OwnVector& u, const OwnVector& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }
inline OwnVector cross(const OwnVector& u, const OwnVector& v) {
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}
inline double norm(const OwnVector& u) { return std::sqrt(dot(u, u)); }
inline double sqrnorm(const OwnVector& u) { return dot(u, u); }
inline OwnVector& normalize(OwnVector& u) { return u *= 1 / norm(u); }
inline OwnVector& vectorize(OwnVector& u, double s) { return u = {s, s, s}; }

template <class PointType>
struct Traits : OpenMesh::DefaultTraits {
    using Point = PointType;
    using Normal = PointType;
};

/// No status requested, as OpenMesh has it by default.
template <class PointType>
using MeshOf = OpenMesh::TriMesh_ArrayKernelT<Traits<PointType>>;

struct Shape {
    std::vector<std::array<int, 3>> vertices;
    std::vector<IndexTriple> faces;
};

/// Fronts are outside.
inline Shape tetrahedron() {
    return {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// Squares of side 2 at z = 0, n each way, each cut from its lower left to its upper right corner; the front is above.
/// Faces 2 i and 2 i + 1 belong to square i: first the lower right one, then the upper left one.
inline Shape grid(int n) {
    Shape shape;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x) shape.vertices.push_back({2 * x, 2 * y, 0});
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const auto at = static_cast<std::uint32_t>(y * (n + 1) + x);
            const auto above = at + static_cast<std::uint32_t>(n + 1);
            shape.faces.push_back({at, at + 1, above + 1});
            shape.faces.push_back({at, above + 1, above});
        }
    }
    return shape;
}

/// Side 2; fronts are outside.
inline Shape cube() {
    return {{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}},
            {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
             {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}}};
}

template <class Point, class Coordinate>
Point point_of(Coordinate x, Coordinate y, Coordinate z) {
    using Value = typename OpenMesh::vector_traits<Point>::value_type;
    Point point{};
    point[0] = static_cast<Value>(x);
    point[1] = static_cast<Value>(y);
    point[2] = static_cast<Value>(z);
    return point;
}

template <class Mesh>
Mesh mesh_of(const Shape& shape) {
    Mesh mesh;
    std::vector<OpenMesh::VertexHandle> handles;
    for (const auto& [x, y, z] : shape.vertices)
        handles.push_back(mesh.add_vertex(point_of<typename Mesh::Point>(x, y, z)));
    for (const auto& [u, v, w] : shape.faces) mesh.add_face(handles[u], handles[v], handles[w]);
    return mesh;
}

template <class Scalar>
TriangleSoup<Scalar> soup_of(const Shape& shape) {
    TriangleSoup<Scalar> soup;
    for (const auto& [x, y, z] : shape.vertices)
        soup.positions.emplace_back(static_cast<Scalar>(x), static_cast<Scalar>(y), static_cast<Scalar>(z));
    soup.triangles = shape.faces;
    return soup;
}

}  // namespace pierce::test

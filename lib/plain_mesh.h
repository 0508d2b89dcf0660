// A mesh as the build reads it: coordinates and indices in arrays with nothing between them. What the caller has
// otherwise is copied to such arrays first, for the time of the build.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>

#include <chunks.h>
#include <pierce/mesh_view.h>
#include <raw_array.h>

namespace pierce::detail {

template <class Scalar>
struct PlainMesh {
    std::span<const Vec3<Scalar>> positions;
    std::span<const IndexTriple> triangles;
    std::span<const std::uint32_t> faces;

    [[nodiscard]] std::uint32_t face_of(std::size_t triangle) const {
        return faces.empty() ? static_cast<std::uint32_t>(triangle) : faces[triangle];
    }
};

/// The caller's mesh as a plain one.
template <class Scalar>
class MadePlain {
    static_assert(sizeof(Vec3<Scalar>) == 3 * sizeof(Scalar) && alignof(Vec3<Scalar>) == alignof(Scalar));
    static_assert(sizeof(IndexTriple) == 3 * sizeof(std::uint32_t));

  public:
    MadePlain(const MeshView<Scalar>& mesh, const Executor& executor)
        : mesh_{plain(
                    mesh.positions.data(), mesh.positions.stride(), mesh.positions.size(), positions_,
                    [&](std::size_t i, Scalar* to) { copy(mesh.positions[i].data(), to); }, executor),
                plain(
                    mesh.triangles.data(), mesh.triangles.stride(), mesh.triangles.size(), triangles_,
                    [&](std::size_t i, std::uint32_t* to) { copy(mesh.triangles[i].data(), to); }, executor),
                mesh.faces} {}
    MadePlain(const MadePlain&) = delete;
    MadePlain& operator=(const MadePlain&) = delete;

    [[nodiscard]] const PlainMesh<Scalar>& mesh() const { return mesh_; }

  private:
    template <class Number>
    static void copy(const Number* from, Number* to) {
        std::memcpy(to, from, 3 * sizeof(Number));
    }
    // Triples of numbers, seen as the type that `Room` stands for. `first` is null where they are of another type.
    template <class Number, class Copy>
    static auto plain(const Number* first, std::ptrdiff_t stride, std::size_t count, RawArray<Number>& room,
                      Copy&& copy_one, const Executor& executor) {
        using Triple = std::conditional_t<std::is_same_v<Number, std::uint32_t>, IndexTriple, Vec3<Scalar>>;
        const bool aligned = reinterpret_cast<std::uintptr_t>(first) % alignof(Number) == 0;
        if (count > 0 && (first == nullptr || !aligned || stride != std::ptrdiff_t{sizeof(Triple)})) {
            room = RawArray<Number>(3 * count);
            each_chunk(executor, count, [&](std::size_t, std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) copy_one(i, &room[3 * i]);
            });
            first = room.data();
        }
        return std::span<const Triple>(reinterpret_cast<const Triple*>(first), count);
    }

    RawArray<Scalar> positions_;
    RawArray<std::uint32_t> triangles_;
    PlainMesh<Scalar> mesh_;
};

}  // namespace pierce::detail

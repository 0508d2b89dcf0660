// The meshes of a world, and the tree over them: what all its queries read, and nothing that they write.
#pragma once

#include <memory>
#include <vector>

#include <pierce/world_hit.h>
#include <query/ways.h>
#include <world/box_walk.h>
#include <rigid/placement.h>

namespace pierce::detail {

/// A mesh where it stands. What a query needs of it is `scene`, whoever owns that: a mesh that deforms in place would
/// come in here, with a scene of its own for each step and `WorldScene::put` for its new box.
template <class Scalar>
struct Instance {
    std::shared_ptr<const void> owner;  ///< of the scene; null: the place is free
    const Scene<Scalar>* scene = nullptr;
    Placement placement;
    std::uint32_t layers = 0;
    std::shared_ptr<const std::vector<std::uint32_t>> face_layers;
    std::uint32_t generation = 1;
    std::int32_t leaf = BoxTree::k_none;  ///< none where there is no triangle
    /// How far from a face's plane a point keeps, in mesh and world alike.
    double grain = 0;

    [[nodiscard]] bool still() const { return placement.stand == Stand::still; }
};

template <class Scalar>
struct WorldScene {
    std::vector<Instance<Scalar>> instances;
    std::vector<std::uint32_t> free;  ///< places of instances; always with room for all of them
    std::size_t posed = 0;            ///< instances that do not stand still
    BoxTree tree;

    [[nodiscard]] MeshId id_of(std::uint32_t index) const { return {index, instances[index].generation}; }
    [[nodiscard]] bool holds(MeshId id) const {
        return id.index < instances.size() && instances[id.index].owner != nullptr &&
               instances[id.index].generation == id.generation;
    }
    [[nodiscard]] std::size_t size() const { return instances.size() - unused(); }

    /// What images may be off for the sake of a way's ends (box_walk.h).
    [[nodiscard]] double noise() const { return posed != 0 ? k_image_slack<Scalar> : 0; }

    // Changes. Those that may throw have changed nothing then.
    std::uint32_t add(Instance<Scalar>&& instance);
    void remove(std::uint32_t index) noexcept;
    void put(std::uint32_t index, std::shared_ptr<const void> owner, const Scene<Scalar>& scene,
             const Placement& placement);

  private:
    [[nodiscard]] std::size_t unused() const { return free.size() + retired; }
    std::size_t retired = 0;  ///< places that all ids were given away of
};

/// Which faces of an instance count for a query.
template <class Scalar>
class FaceFilter {
  public:
    FaceFilter(const Instance<Scalar>& instance, std::uint32_t mask)
        : scene_(instance.scene), layers_(instance.face_layers.get()), mask_(mask) {}

    [[nodiscard]] bool counts(TriangleRef triangle) const {
        if (layers_ == nullptr) return true;
        const std::uint32_t face = scene_->face_of(triangle);
        return face < layers_->size() && ((*layers_)[face] & mask_) != 0;
    }

  private:
    const Scene<Scalar>* scene_;
    const std::vector<std::uint32_t>* layers_;
    std::uint32_t mask_;
};

/// Whether a ray's way is not in the range in which the filter is proved for floats (ray_path.cpp).
template <class Scalar>
[[nodiscard]] bool is_wild(const Point& way) {
    if (sizeof(Scalar) == sizeof(double)) return false;
    for (const double x : way)
        if (x != 0 && !(std::abs(x) >= 0x1p-200 && std::abs(x) <= 0x1p200)) return true;
    return false;
}

/// The image of a path in an instance. False: it is not finite, and nothing is hit.
template <class Scalar>
[[nodiscard]] bool set_local_path(const Instance<Scalar>& instance, const Path& path, Path& local) {
    local = path;
    if (instance.still()) return true;
    local.from = image_of<Scalar>(instance.placement, path.from);
    local.to =
        path.ray ? direction_of<Scalar>(instance.placement, path.to) : image_of<Scalar>(instance.placement, path.to);
    if (path.ray) local.wild = is_wild<Scalar>(local.to);
    return are_finite(local.from, local.to);
}

}  // namespace pierce::detail

// Changes of the set of meshes.
#include <world/instances.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <query/grain.h>

namespace pierce::detail {

namespace {

constexpr std::size_t k_most_instances = std::size_t{1} << 30;

// The box of an instance, and how far beyond it local hits may lie (placement.h, box_walk.h).
struct Extent {
    Box box;
    double slack;
    double largest;  ///< |coordinate|
};

template <class Scalar>
[[gnu::noinline]] Extent extent_of(const Scene<Scalar>& scene, const Placement& placement) {
    Extent extent{box_of(placement, scene.bounds), 0, 0};
    double away = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        extent.largest = std::max({extent.largest, std::abs(extent.box.low[k]), std::abs(extent.box.high[k])});
        away = std::max(away, std::abs(placement.translation[k]));
    }
    extent.slack = k_box_slack * extent.largest;
    if (placement.stand != Stand::still)
        extent.slack +=
            k_image_slack<Scalar> * away + 4 * static_cast<double>(std::numeric_limits<Scalar>::denorm_min());
    return extent;
}

// Half a grain is enough for a point that went from the mesh to the world and back: two roundings to Scalar, less than
// a unit each along the normal. For double the arithmetic of a rotation is not better than that: 7 roundings, 8 units
// where the coordinates are just above a power of two; so it has four times as much.
template <class Scalar>
double grain_at(const Scene<Scalar>& scene, const Placement& placement, double largest) {
    if (placement.stand == Stand::still) return scene.grain;
    const double grain = std::max(scene.grain, grain_of<Scalar>(largest));
    return sizeof(Scalar) == sizeof(double) ? 4 * grain : grain;
}

}  // namespace

template <class Scalar>
void WorldScene<Scalar>::put(std::uint32_t index, std::shared_ptr<const void> owner, const Scene<Scalar>& scene,
                             const Placement& placement) {
    Instance<Scalar>& instance = instances[index];
    if (scene.empty()) {
        if (instance.leaf != BoxTree::k_none) tree.remove(instance.leaf);
        instance.leaf = BoxTree::k_none;
        instance.grain = 0;
    } else {
        Extent extent = extent_of(scene, placement);
        const double grain = grain_at(scene, placement, extent.largest);
        extent.slack += near_margin(grain);  // near.h
        if (instance.leaf == BoxTree::k_none)
            instance.leaf = tree.insert(extent.box, extent.slack, index);  // may throw
        else
            tree.move(instance.leaf, extent.box, extent.slack);
        instance.grain = grain;
    }
    const auto counted = [](const Placement& p) { return p.stand != Stand::still ? std::size_t{1} : 0; };
    if (instance.owner != nullptr) posed -= counted(instance.placement);
    posed += counted(placement);
    instance.owner = std::move(owner);
    instance.scene = &scene;
    instance.placement = placement;
}

template <class Scalar>
std::uint32_t WorldScene<Scalar>::add(Instance<Scalar>&& given) {
    // All that may throw comes first.
    const bool again = !free.empty();
    if (!again) {
        if (instances.size() >= k_most_instances) throw std::length_error("a world has room for 2^30 meshes");
        if (free.capacity() <= instances.size()) free.reserve(2 * instances.size() + 1);
        instances.emplace_back();
    }
    const auto index = again ? free.back() : static_cast<std::uint32_t>(instances.size() - 1);
    try {
        put(index, std::move(given.owner), *given.scene, given.placement);
    } catch (...) {
        if (!again) instances.pop_back();
        throw;
    }
    if (again) free.pop_back();
    instances[index].layers = given.layers;
    instances[index].face_layers = std::move(given.face_layers);
    return index;
}

template <class Scalar>
void WorldScene<Scalar>::remove(std::uint32_t index) noexcept {
    Instance<Scalar>& instance = instances[index];
    if (instance.leaf != BoxTree::k_none) tree.remove(instance.leaf);
    if (!instance.still()) --posed;
    const std::uint32_t generation = instance.generation;
    instance = {};
    instance.generation = generation + 1;
    // Of a place without an unused id, generation 0 is left.
    if (instance.generation == 0)
        ++retired;
    else
        free.push_back(index);
}

template struct WorldScene<float>;
template struct WorldScene<double>;

}  // namespace pierce::detail

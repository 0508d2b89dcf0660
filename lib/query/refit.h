// New positions for the triangles of a scene: records and bounds are written again where they are, in the order that
// the build found.
//
// A triangle stays in the cluster that it was built into. One that loses its area leaves the record, and its cluster
// gets another name, which says how many are left (cluster/record.h), or none, and is closed; one that gets its area
// back returns. Only what had no area when the scene was built has no cluster to go to: with it the scene is built
// anew.
// So a scene has the same clusters' triangles, degenerate triangles, bounds, grain and noise as one that is built from
// the same positions, and what a query answers depends on nothing else.
#pragma once

#include <span>
#include <vector>

#include <number_set.h>
#include <plain_mesh.h>
#include <query/scene.h>
#include <tree/refit.h>

namespace pierce::detail {

/// What a scene needs to take new positions, beside what it has: made when the first ones come.
template <class Scalar>
class Refit {
  public:
    /// The scene must not be empty.
    explicit Refit(const Scene<Scalar>& scene);

    /// All positions, as many as there are vertices. False: the scene has to be built anew from them, and is as it was.
    /// Throws `MeshError` for a coordinate that is not finite, and where the mesh is too small for its distance from
    /// the origin; the scene is as it was then.
    [[nodiscard]] bool all(Scene<Scalar>& scene, const PointsView<Scalar>& positions, const BuildOptions& options,
                           const Executor& executor);
    /// Only those of `changed` vertices, which exist, are looked at.
    [[nodiscard]] bool some(Scene<Scalar>& scene, const PointsView<Scalar>& positions,
                            std::span<const std::uint32_t> changed, const BuildOptions& options);

    /// Where all vertices are, and where they were to be when `all` or `some` was false.
    [[nodiscard]] std::span<const Vec3<Scalar>> positions() const { return view(now_); }
    [[nodiscard]] std::span<const Vec3<Scalar>> wanted() const { return view(next_); }

    /// What a query costs now, in parts of what it did when the scene was built.
    [[nodiscard]] double cost(const Scene<Scalar>& scene) const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    using Numbers = std::vector<std::uint32_t>;

    static std::span<const Vec3<Scalar>> view(const RawArray<Scalar>& positions) {
        static_assert(sizeof(Vec3<Scalar>) == 3 * sizeof(Scalar) && alignof(Vec3<Scalar>) == alignof(Scalar));
        return {reinterpret_cast<const Vec3<Scalar>*>(positions.data()), positions.size() / 3};
    }
    [[nodiscard]] PlainMesh<Scalar> mesh(const Scene<Scalar>& scene, const RawArray<Scalar>& positions) const {
        return {view(positions), {scene.triangles.data(), scene.triangles.size()}, {}};
    }
    void read_positions(const Scene<Scalar>& scene);
    void read_clusters(const Scene<Scalar>& scene);
    void find_clusters_of_vertices(const Scene<Scalar>& scene);
    [[nodiscard]] bool touch(const Scene<Scalar>& scene, std::span<const std::uint32_t> changed);
    void rewrite_all(Scene<Scalar>& scene, const RawArray<Scalar>& positions, Numbers& degenerate,
                     const Executor& executor);
    void rewrite_touched(Scene<Scalar>& scene, Numbers& degenerate);
    [[nodiscard]] QuadBox<Scalar> box_of_all() const;
    void set_names(Scene<Scalar>& scene);
    void set_bounds_of_touched(Scene<Scalar>& scene, const QuadBox<Scalar>& box, double unit);
    void make_new_grid(Scene<Scalar>& scene, const BuildOptions& options, const Executor& executor) const;
    void keep_degenerate(Scene<Scalar>& scene, Numbers& degenerate) const;
    void keep_degenerate_of_touched(Scene<Scalar>& scene, Numbers& degenerate) const;

    TreeShape shape_;
    TreeBoxes<Scalar> boxes_;
    Numbers numbers_;   ///< of the triangle at each place; 0 where there is none
    Numbers homeless_;  ///< triangles that had no area when the scene was built
    double cost_when_built_ = 0;
    bool renamed_ = false;  ///< clusters have other names than the scene's list says
    RawArray<Scalar> now_;
    RawArray<Scalar> next_;
    // For `some`, from its first call on.
    Numbers first_of_vertex_;     ///< the clusters of vertex v are from [v] to [v + 1]
    Numbers clusters_of_vertex_;  ///< or `k_leaf_bit` and a homeless triangle
    NumberSet touched_;           ///< clusters
    NumberSet dirty_;             ///< nodes
};

}  // namespace pierce::detail

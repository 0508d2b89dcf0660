// One cluster of a refit, and what a refit asks of triangles and of all of them.
#pragma once

#include <atomic>
#include <optional>

#include <cluster/make_clusters.h>
#include <cluster/write_cluster.h>
#include <exact/decide.h>
#include <tree/refit.h>

namespace pierce::detail {

/// Writes records again where they are, for one thread. `numbers`: of the triangle at each place. `without_area`
/// decides, where floating point cannot, which triangles are left out.
template <class Scalar>
class RecordRewriter {
  public:
    RecordRewriter(const PlainMesh<Scalar>& mesh, std::span<const std::uint32_t> numbers, Clusters<Scalar>& clusters,
                   HasZeroArea without_area = has_zero_area)
        : writer_(CornerReader<Scalar>(mesh), numbers.data(), Scalar(1), std::numeric_limits<Scalar>::infinity(),
                  without_area, clusters.records.data()),
          last_(static_cast<std::uint32_t>(numbers.size())),
          empty_(clusters.empty) {}

    /// Writes the record of a cluster, its box and its name. Returns whether the name is another than before.
    bool rewrite(const ClusterHome& home, ClusterBox<Scalar>& box, std::vector<std::uint32_t>& degenerate) {
        const std::uint32_t begin = first_of(home.ref);
        const ClusterRef before = box.ref;
        if (!writer_.rewrite(begin, begin + count_of(home.ref), last_, box, degenerate)) {
            box.ref = empty_;
            set_box(box, QuadBox<Scalar>{});
        }
        return box.ref != before;
    }

  private:
    ClusterWriter<Scalar, std::uint32_t> writer_;
    std::uint32_t last_;
    ClusterRef empty_;
};

template <class Scalar>
[[nodiscard]] bool has_area(const PlainMesh<Scalar>& mesh, std::uint32_t triangle) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = to_point(mesh.positions[mesh.triangles[triangle][k]]);
    Quad<double> rows[9];
    for (std::size_t r = 0; r < 9; ++r) rows[r] = all_of(corners[r / 3][r % 3]);
    return certainly_have_area<double>(rows)[0] != 0 || !has_zero_area(corners);
}

/// The unit of a scene in this box. Where it has none, being empty or too small for its distance from the origin
/// (`MeshError`), the refit is undone first.
template <class Scalar, class Restore>
[[nodiscard]] std::optional<double> unit_or_undo(const QuadBox<Scalar>& box, Restore&& restore) {
    if (is_empty(box)) {
        restore();
        return std::nullopt;
    }
    try {
        return static_cast<double>(scene_unit(box));
    } catch (const MeshError&) {
        restore();
        throw;
    }
}

}  // namespace pierce::detail

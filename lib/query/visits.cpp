// Which boxes of the broadphase a segment comes to. In double, box by box: what is shown, not what is decided.
#include <pierce/visits.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <environment.h>
#include <query/inside.h>

namespace pierce {
namespace detail {
namespace {

/// Where the path comes to a box, if it does; a millionth of the box's coordinates is taken for rounding.
std::optional<double> entry(const Path& path, const Box& box) {
    double first = 0, last = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double slack = 1e-6 * (std::abs(box.low[k]) + std::abs(box.high[k]));
        const double low = box.low[k] - slack, high = box.high[k] + slack;
        const double way = path.to[k] - path.from[k];
        if (way == 0) {
            if (path.from[k] < low || path.from[k] > high) return std::nullopt;
            continue;
        }
        const double near = ((way > 0 ? low : high) - path.from[k]) / way;
        const double far = ((way > 0 ? high : low) - path.from[k]) / way;
        first = std::max(first, near);
        last = std::min(last, far);
    }
    return first <= last ? std::optional(first) : std::nullopt;
}

/// The box of child `k` in the caller's coordinates. An empty place has a low bound above its high one.
template <class AnyNode>
std::optional<Box> child_box(const AnyNode& node, unsigned k, const Frame& frame) {
    Box box{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = node.bounds[2 * axis][k], high = node.bounds[2 * axis + 1][k];
        if (low > high) return std::nullopt;
        double origin = frame.low[axis], step = frame.step;
        if constexpr (std::is_same_v<AnyNode, CoarseNode>) {
            origin += node.origin[axis];
            step = static_cast<double>(node.step[axis]);
        }
        box.low[axis] = (origin + low * step) / frame.unit;
        box.high[axis] = (origin + high * step) / frame.unit;
    }
    return box;
}

template <class Scalar>
Box box_of(const Scene<Scalar>& scene, ClusterRef cluster) {
    Box box = detail::box_of(scene.corners({cluster, 0}));
    for (std::uint32_t lane = 1; lane < count_of(cluster); ++lane) {
        const Box more = detail::box_of(scene.corners({cluster, lane}));
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] = std::min(box.low[k], more.low[k]);
            box.high[k] = std::max(box.high[k], more.high[k]);
        }
    }
    return box;
}

template <class Scalar>
class Walk {
  public:
    Walk(const Scene<Scalar>& scene, const Path& path, double up_to) : scene_(scene), path_(path), up_to_(up_to) {}

    void open(std::uint32_t child, const Box& box) {
        const bool is_cluster = (child & k_leaf_bit) != 0;
        const auto at = entry(path_, box);
        if (!at || *at > up_to_) return;
        const auto vector = [](const Point& p) { return Vec3<double>(p[0], p[1], p[2]); };
        boxes.push_back({vector(box.low), vector(box.high), is_cluster, *at});
        if (is_cluster) return;
        if (scene_.tree.coarse)
            open_children<CoarseNode>(child);
        else
            open_children<Node>(child);
    }

    std::vector<VisitedBox> boxes;

  private:
    template <class AnyNode>
    void open_children(std::uint32_t number) {
        const AnyNode& node = static_cast<const AnyNode*>(scene_.tree.view().nodes)[number];
        for (unsigned k = 0; k < k_children; ++k) {
            const auto box = child_box(node, k, scene_.frame);
            if (!box) continue;
            // A cluster's own box is the tighter one, but what a query opens is what the node says.
            open(node.child[k], *box);
        }
    }

    const Scene<Scalar>& scene_;
    const Path& path_;
    double up_to_;
};

template <class Scalar>
[[gnu::noinline]] std::vector<VisitedBox> visited_boxes(const Scene<Scalar>& scene, const Path& path, double up_to) {
    Walk<Scalar> walk(scene, path, up_to);
    if (scene.empty()) return {};
    if (scene.broadphase == Broadphase::grid)
        for (const ClusterRef cluster : scene.cluster_refs) walk.open(cluster, box_of(scene, cluster));
    else
        walk.open(scene.tree.root, scene.bounds);
    std::stable_sort(walk.boxes.begin(), walk.boxes.end(),
                     [](const VisitedBox& a, const VisitedBox& b) { return a.fraction < b.fraction; });
    return std::move(walk.boxes);
}

}  // namespace
}  // namespace detail

template <class Scalar>
std::vector<VisitedBox> visited_boxes(const CollisionMesh<Scalar>& mesh, const Segment<Scalar>& segment, double up_to) {
    const detail::StandardArithmetic standard;
    if (!segment.from.allFinite() || !segment.to.allFinite()) return {};
    return detail::visited_boxes(detail::Inside::of(mesh).scene, detail::to_path(segment), up_to);
}

template std::vector<VisitedBox> visited_boxes(const CollisionMesh<float>&, const Segment<float>&, double);
template std::vector<VisitedBox> visited_boxes(const CollisionMesh<double>&, const Segment<double>&, double);

}  // namespace pierce

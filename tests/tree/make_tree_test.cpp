// Every cluster is at one place of the tree, in boxes that hold all of it: in rational numbers, from the root down.
#include <algorithm>
#include <cstring>
#include <optional>

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cluster/frame.h>
#include <exact/decide.h>
#include <support/cluster_meshes.h>
#include <support/executors.h>
#include <tree/make_tree.h>

namespace pierce::test {
namespace {

struct ExactBox {
    std::array<mpq_class, 3> low, high;

    void add(const ExactBox& box) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (box.low[k] < low[k]) low[k] = box.low[k];
            if (box.high[k] > high[k]) high[k] = box.high[k];
        }
    }
    [[nodiscard]] bool holds(const ExactBox& box) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (box.low[k] < low[k] || box.high[k] > high[k]) return false;
        return true;
    }
};

template <class Scalar>
class Checker {
  public:
    Checker(const detail::Clusters<Scalar>& clusters, const detail::Tree& tree, const detail::Frame& frame)
        : clusters_(clusters), tree_(tree), frame_(frame) {}

    /// What the tree below `child` holds; none if something is wrong.
    std::optional<ExactBox> check(std::uint32_t child, unsigned depth) {
        if (child & detail::k_leaf_bit) {
            found.push_back(child);
            return box_of_cluster(child);
        }
        deepest = std::max(deepest, depth);
        ++nodes;
        if (child >= tree_.node_count || depth > detail::k_most_depth) return {};
        if (tree_.coarse) return check_node(static_cast<const detail::CoarseNode*>(tree_.view().nodes)[child], depth);
        return check_node(static_cast<const detail::Node*>(tree_.view().nodes)[child], depth);
    }

    std::vector<detail::ClusterRef> found;
    unsigned deepest = 0;
    std::size_t nodes = 0;

  private:
    ExactBox box_of_cluster(detail::ClusterRef ref) const {
        std::optional<ExactBox> box;
        for (unsigned lane = 0; lane < detail::count_of(ref); ++lane)
            for (const detail::Point& corner : clusters_.corners(ref, lane)) {
                ExactBox point;
                for (std::size_t k = 0; k < 3; ++k)
                    point.low[k] = point.high[k] = mpq_class(corner[k]) * mpq_class(frame_.unit);
                if (box)
                    box->add(point);
                else
                    box = point;
            }
        return *box;
    }
    static mpq_class bound(const detail::Node& node, std::size_t row, unsigned i, const detail::Frame& frame) {
        return mpq_class(frame.low[row / 2]) + node.bounds[row][i] * mpq_class(frame.step);
    }
    static mpq_class bound(const detail::CoarseNode& node, std::size_t row, unsigned i, const detail::Frame& frame) {
        return mpq_class(frame.low[row / 2]) + mpq_class(node.origin[row / 2]) +
               node.bounds[row][i] * mpq_class(static_cast<double>(node.step[row / 2]));
    }
    template <class Kind>
    std::optional<ExactBox> check_node(const Kind& node, unsigned depth) {
        std::optional<ExactBox> all;
        for (unsigned i = 0; i < detail::k_children; ++i) {
            if (node.child[i] == clusters_.empty) {
                for (std::size_t k = 0; k < 3; ++k)
                    if (node.bounds[2 * k][i] <= node.bounds[2 * k + 1][i]) return {};
                continue;
            }
            const std::optional<ExactBox> below = check(node.child[i], depth + 1);
            ExactBox box;
            for (std::size_t k = 0; k < 3; ++k) {
                box.low[k] = bound(node, 2 * k, i, frame_);
                box.high[k] = bound(node, 2 * k + 1, i, frame_);
                if constexpr (std::is_same_v<Kind, detail::Node>)
                    if (node.bounds[2 * k][i] < 1 || node.bounds[2 * k + 1][i] > 65534) return {};
            }
            if (!below || !box.holds(*below)) return {};
            if (all)
                all->add(*below);
            else
                all = below;
        }
        return all;
    }

    const detail::Clusters<Scalar>& clusters_;
    const detail::Tree& tree_;
    const detail::Frame& frame_;
};

template <class Scalar>
struct Built {
    detail::ClusterBuild<Scalar> build;
    detail::Frame frame;
    detail::Tree tree;

    Built(const MeshView<Scalar>& mesh, const Executor& executor)
        : build(detail::make_clusters(detail::MadePlain<Scalar>(mesh, {}).mesh(), detail::has_zero_area, executor)) {
        frame = detail::frame_of(build);
        tree =
            detail::make_tree<Scalar>({build.boxes.data(), build.boxes.size()}, build.clusters.empty, frame, executor);
    }
};

template <class Scalar>
detail::Tree expect_sound(const MeshView<Scalar>& mesh, const char* what) {
    SCOPED_TRACE(what);
    Built<Scalar> built(mesh, {});
    Checker<Scalar> checker(built.build.clusters, built.tree, built.frame);
    EXPECT_TRUE(checker.check(built.tree.root, 1).has_value());
    EXPECT_EQ(checker.deepest, built.tree.depth);
    EXPECT_LE(built.tree.depth, detail::k_most_depth);
    EXPECT_EQ(checker.nodes, built.tree.node_count);
    std::vector<detail::ClusterRef> all;
    for (const auto& box : built.build.boxes) all.push_back(box.ref);
    std::sort(all.begin(), all.end());
    std::sort(checker.found.begin(), checker.found.end());
    EXPECT_EQ(checker.found, all);
    int exponent = 0;
    EXPECT_EQ(std::frexp(built.frame.step, &exponent), 0.5);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(built.frame.high[k], static_cast<double>(static_cast<Scalar>(built.build.high[k]) *
                                                           static_cast<Scalar>(built.build.unit)));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(built.tree.nodes.data()) % 64, 0U);

    for (const Executor& executor : {Executor(Reversed()), Executor(Threads())}) {
        const Built<Scalar> other(mesh, executor);
        EXPECT_EQ(other.tree.root, built.tree.root);
        EXPECT_EQ(other.tree.coarse, built.tree.coarse);
        EXPECT_EQ(other.tree.depth, built.tree.depth);
        if (other.tree.node_count != built.tree.node_count) {
            ADD_FAILURE() << "nodes";
        } else if (other.tree.node_count > 0) {
            EXPECT_EQ(std::memcmp(other.tree.nodes.data(), built.tree.nodes.data(),
                                  built.tree.node_count * sizeof(detail::Node)),
                      0);
        }
    }
    return std::move(built.tree);
}

template <class Scalar>
class MakeTree : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(MakeTree, Scalars);

TYPED_TEST(MakeTree, AllSizesOfScenes) {
    using Limits = std::numeric_limits<TypeParam>;
    EXPECT_FALSE(expect_sound(random_soup<TypeParam>(20000, 0.02, 1, 0, 1).view(), "unit cube").coarse);
    EXPECT_FALSE(expect_sound(random_soup<TypeParam>(3000, 1, 1, 0, 2).view(), "large faces").coarse);
    expect_sound(random_soup<TypeParam>(300, 1, 1, static_cast<double>(1 / Limits::epsilon()) / 64, 3).view(),
                 "so far that few numbers are left");
    for_each_extreme_soup<TypeParam>([](const auto& soup, const char* what) { expect_sound(soup.view(), what); });
}

TYPED_TEST(MakeTree, FacesSmallerThanTheLattice) {
    for (const double size : {3e-4, 1e-4, 1e-5})
        EXPECT_TRUE(expect_sound(teapot_in_stadium<TypeParam>(10000, size).view(), "teapot").coarse);
}

TYPED_TEST(MakeTree, AllSizesInOneScene) {
    for (const int copies : {1, 9, 40}) expect_sound(nested_soup_of_all_sizes<TypeParam>(copies).view(), "nested");
    expect_sound(nested_soup<TypeParam>(-60, 20, 20).view(), "nested less deep");
}

TYPED_TEST(MakeTree, OneTriangleAgainAndAgain) {
    TriangleSoup<TypeParam> soup;
    add_triangle(soup, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(expect_sound(soup.view(), "one").node_count, 0U);
    for (const std::size_t count : {8U, 9U, 17U, 150U, 100000U}) {
        soup.triangles.assign(count, soup.triangles[0]);
        expect_sound(soup.view(), "many");
    }
}

}  // namespace
}  // namespace pierce::test

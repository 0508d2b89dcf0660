// One mesh three times: by the tree, by the grid, and naive. All of them must give the same bits.
#pragma once

#include <string>

#include <pierce/collision_mesh.h>
#include <support/expect_hit.h>
#include <support/naive.h>
#include <support/random.h>

namespace pierce::test {

template <class Scalar>
class Twins {
  public:
    explicit Twins(const TriangleSoup<Scalar>& soup, BuildOptions build = {})
        : tree_(soup.view(), with(build, Broadphase::tree)),
          grid_(soup.view(), with(build, Broadphase::grid)),
          naive_(soup.view()) {}

    [[nodiscard]] double cell_size() const { return grid_.statistics().cell_size; }
    [[nodiscard]] const CollisionMesh<Scalar>& grid() const { return grid_; }
    [[nodiscard]] int hits() const { return hits_; }

    void expect_same_first(const Segment<Scalar>& segment, const QueryOptions& options) {
        const auto hit = naive_.first_hit(segment, options);
        hits_ += hit.has_value() ? 1 : 0;
        for (const auto* mesh : {&tree_, &grid_}) {
            SCOPED_TRACE(mesh == &tree_ ? "tree" : "grid");
            ASSERT_TRUE(same_answer(mesh->first_hit(segment, options), hit)) << to_text(segment);
            ASSERT_EQ(mesh->any_hit(segment, options), hit.has_value()) << to_text(segment);
        }
    }

    void expect_same_all(const Segment<Scalar>& segment, const QueryOptions& options) {
        std::array<Hit<Scalar>, 4> some;
        std::array<Hit<Scalar>, 4> expected;
        const std::size_t total = naive_.all_hits(segment, expected, options);
        for (const auto* mesh : {&tree_, &grid_}) {
            SCOPED_TRACE(mesh == &tree_ ? "tree" : "grid");
            ASSERT_EQ(mesh->all_hits(segment, some, options), total) << to_text(segment);
            for (std::size_t k = 0; k < std::min(total, some.size()); ++k)
                ASSERT_TRUE(same_bits(some[k], expected[k]))
                    << "hit " << k << ": " << to_text(segment) << "\n  " << to_text(std::optional(some[k])) << "\n  "
                    << to_text(std::optional(expected[k]));
        }
        ASSERT_EQ(tree_.crossings(segment), grid_.crossings(segment)) << to_text(segment);
    }

  private:
    static BuildOptions with(BuildOptions build, Broadphase broadphase) {
        build.broadphase = broadphase;
        return build;
    }

    CollisionMesh<Scalar> tree_;
    CollisionMesh<Scalar> grid_;
    NaiveMesh<Scalar> naive_;
    int hits_ = 0;
};

/// Asks all of them about `count` segments, with options of all kinds; each fourth time for all hits as well.
template <class Scalar, class Make>
void compare_twins(Twins<Scalar>& twins, int count, Random& random, Make&& make) {
    for (int i = 0; i < count; ++i) {
        const Segment<Scalar> segment = make();
        QueryOptions options;
        options.sides = std::array{Sides::front, Sides::back, Sides::both}[random.below(3)];
        if (random.chance(0.2)) options.max_fraction = random.unit();
        twins.expect_same_first(segment, options);
        if (i % 4 == 0) twins.expect_same_all(segment, options);
        if (testing::Test::HasFatalFailure()) return;
    }
}

}  // namespace pierce::test

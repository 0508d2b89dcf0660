// What batches take as it lies in memory, and what they refuse.
#include <gtest/gtest.h>
#include <query/batch_world.h>
#include <support/expect_hit.h>

namespace pierce::test {
namespace {

// A matrix whose columns do not lie together would have to be copied, and the view would outlive the copy.
TEST(BatchViews, take_what_lies_in_memory_and_refuse_what_would_be_copied_or_rounded) {
    using RowMajor = Eigen::Matrix<float, 3, Eigen::Dynamic, Eigen::RowMajor>;
    using Columns = Eigen::Matrix<float, 3, Eigen::Dynamic>;
    static_assert(std::is_constructible_v<PointsView<float>, const Columns&>);
    static_assert(std::is_constructible_v<PointsView<float>, const Eigen::Block<Eigen::MatrixXf>&>);
    static_assert(!std::is_constructible_v<PointsView<float>, const RowMajor&>);
    static_assert(!std::is_constructible_v<PointsView<float>, const Eigen::Transpose<Eigen::MatrixXf>&>);
    static_assert(!std::is_constructible_v<PointsView<float>, decltype(Columns() + Columns())>);
    static_assert(!std::is_constructible_v<PointsView<float>, const Eigen::Matrix3Xd&>);
    static_assert(!std::is_constructible_v<PointsView<float>, const std::vector<Vec3<double>>&>);
    static_assert(!std::is_constructible_v<PointsView<float>, const double*, std::size_t>);
    static_assert(std::is_trivially_copyable_v<Segments<float>>);
}

// A matrix with a point in each row, as libigl has it, was taken for three points that lie far apart.
TEST(BatchViews, of_matrices_need_three_rows) {
    for (const Eigen::Index rows : {0, 2, 4, 100}) {
        const Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, 3);
        try {
            const PointsView<double> points(matrix);
            ADD_FAILURE() << rows << " rows are " << points.size() << " points";
        } catch (const std::invalid_argument& error) {
            EXPECT_EQ(error.what(), "points are the columns of a matrix with 3 rows, not " + std::to_string(rows));
        }
    }
    const Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(3, 100);
    EXPECT_EQ(PointsView<double>(columns).size(), 100U);
}

// Floats of a sensor against a mesh in double: widened one by one, nothing is copied.
TEST(BatchViews, in_double_take_floats) {
    const TriangleSoup<double> soup = lattice_and_shards<double>();
    const CollisionMesh<double> mesh(soup.view());
    std::vector<Vec3<float>> starts;
    std::vector<Vec3<float>> ends;
    std::vector<std::optional<Hit<double>>> expected;
    for (const auto& s : batch_segments(lattice_and_shards<float>().view(), 500, 1)) {
        starts.push_back(s.from);
        ends.push_back(s.to);
        expected.push_back(mesh.first_hit({s.from.cast<double>(), s.to.cast<double>()}));
    }
    std::vector<std::optional<Hit<double>>> out(starts.size());
    EXPECT_GT(mesh.first_hits({starts, ends}, out), 50U);
    for (std::size_t i = 0; i < out.size(); ++i) ASSERT_TRUE(same_answer(out[i], expected[i])) << i;
}

}  // namespace
}  // namespace pierce::test

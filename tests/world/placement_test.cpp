// Poses: what is refused, how near images are, and boxes that hold what they have to; rationals are the judge.
#include <cmath>
#include <stdexcept>

#include <gmpxx.h>
#include <gtest/gtest.h>
#include <support/random.h>
#include <world/naive_world.h>
#include <rigid/placement.h>

namespace pierce::test {
namespace {

template <class Scalar>
class Placements : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Placements, Scalars);

template <class Scalar>
Pose<Scalar> random_pose(Random& random, double away) {
    const auto whole = [&] { return random.between_ints(-9, 9); };
    int w = whole();
    if (w == 0) w = 1;
    const int x = whole();
    const int y = whole();
    const int z = whole();
    Pose<Scalar> pose;
    pose.rotation = rotation_of<Scalar>(w, x, y, z);
    pose.translation = (away * random.in_cube()).template cast<Scalar>();
    return pose;
}

TYPED_TEST(Placements, what_is_no_pose_is_refused) {
    using Scalar = TypeParam;
    const auto refused = [](const Pose<Scalar>& pose) {
        EXPECT_THROW((void)detail::make_placement(pose), std::invalid_argument);
    };
    constexpr Scalar k_nan = std::numeric_limits<Scalar>::quiet_NaN();
    constexpr Scalar k_infinite = std::numeric_limits<Scalar>::infinity();
    Pose<Scalar> pose;
    for (const Scalar bad : {k_nan, k_infinite, -k_infinite})
        for (int k = 0; k < 3; ++k) {
            pose = {};
            pose.translation[k] = bad;
            refused(pose);
            for (int j = 0; j < 3; ++j) {
                pose = {};
                pose.rotation(k, j) = bad;
                refused(pose);
            }
        }
    for (const double scale : {0.0, 0.5, 0.999, 1.001, 2.0, -1.0}) {
        pose = {};
        pose.rotation *= static_cast<Scalar>(scale);
        refused(pose);
    }
    pose = {};
    pose.rotation(0, 0) = -1;  // mirrors
    refused(pose);
    pose = {};
    pose.rotation(0, 1) = Scalar(0.01);  // shears
    refused(pose);
    pose = {};
    pose.rotation(0, 1) = Scalar(0x1p-16);  // off by rounding or drift
    EXPECT_NO_THROW((void)detail::make_placement(pose));
}

// Of R^T R - I, in rationals: the bound of placement.h.
TYPED_TEST(Placements, rotations_are_made_exact) {
    using Scalar = TypeParam;
    Random random(1);
    double worst = 0;
    for (int i = 0; i < 300; ++i) {
        Pose<Scalar> pose = random_pose<Scalar>(random, 1);
        if (i % 2 == 1)  // drift
            for (int k = 0; k < 9; ++k) pose.rotation(k) += static_cast<Scalar>(0x1p-17 * random.between(-1, 1));
        const detail::Placement placement = detail::make_placement(pose);
        const auto& r = placement.rotation;
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b) {
                mpq_class sum = a == b ? -1 : 0;
                for (std::size_t k = 0; k < 3; ++k) sum += mpq_class(r[k][a]) * mpq_class(r[k][b]);
                worst = std::max(worst, std::abs(sum.get_d()));
                EXPECT_NEAR(r[a][b], double(pose.rotation(Eigen::Index(a), Eigen::Index(b))), 0x1p-13);
            }
    }
    std::cout << "off by " << worst * 0x1p53 << " u\n";
    EXPECT_LE(worst, 24 * 0x1p-53);
}

// The rotation of a quaternion of whole numbers is a matrix of rationals, and the true image one of rationals.
TYPED_TEST(Placements, images_are_as_near_as_is_said) {
    using Scalar = TypeParam;
    Random random(2);
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
        const double away = std::exp(random.between(-8, 8));
        const auto whole = [&] { return random.between_ints(-9, 9); };
        const int w = 1 + random.between_ints(0, 8);
        const int x = whole();
        const int y = whole();
        const int z = whole();
        Pose<Scalar> pose;
        pose.rotation = rotation_of<Scalar>(w, x, y, z);
        pose.translation = (away * random.in_cube()).template cast<Scalar>();
        const Vec3<Scalar> p = (std::exp(random.between(-8, 8)) * random.in_cube()).template cast<Scalar>();
        const detail::Placement placement = detail::make_placement(pose);
        const detail::Point image = detail::image_of<Scalar>(placement, detail::to_point(p));
        const mpq_class n = w * w + x * x + y * y + z * z;
        const int q[3][3] = {{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
                             {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
                             {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
        mpq_class off = 0;
        mpq_class length = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            mpq_class sum = 0;
            for (int j = 0; j < 3; ++j)
                sum += q[j][k] * (mpq_class(double(p[j])) - mpq_class(double(pose.translation[j])));
            const mpq_class d = sum / n - mpq_class(image[k]);
            off += d * d;
            length += sum * sum / (n * n);
        }
        worst = std::max(worst, std::sqrt(mpq_class(off / length).get_d()));
    }
    // The pose's own numbers were rounded to Scalar: two units more.
    const double said = sizeof(Scalar) == 4 ? 0x1p-23 : 0x1p-46;
    std::cout << "off by " << worst / said << " of what is allowed\n";
    EXPECT_LE(worst, said + 2 * double(std::numeric_limits<Scalar>::epsilon()));
    EXPECT_GE(worst, said / 256) << "the bound says something";
}

// Exact where nothing is rounded: lattice coordinates, moved by lattice vectors, axes swapped.
TYPED_TEST(Placements, images_on_a_lattice_are_exact) {
    using Scalar = TypeParam;
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        Pose<Scalar> pose;
        const int turn = i % 4;
        if (turn == 1) pose.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
        if (turn == 2) pose.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
        if (turn == 3) pose.rotation << -1, 0, 0, 0, -1, 0, 0, 0, 1;
        Vec3<Scalar> p;
        for (int k = 0; k < 3; ++k) {
            p[k] = static_cast<Scalar>(random.between_ints(-4096, 4096)) / 8;
            pose.translation[k] = static_cast<Scalar>(random.between_ints(-4096, 4096)) / 8;
        }
        const detail::Placement placement = detail::make_placement(pose);
        const Vec3<Scalar> expected = pose.rotation.transpose() * (p - pose.translation);
        EXPECT_EQ(detail::to_mesh(placement, p), expected);
        EXPECT_EQ(detail::to_world(placement, expected), p);
    }
    const detail::Placement none = detail::make_placement(Pose<Scalar>{});
    EXPECT_EQ(none.stand, detail::Stand::still);
    const Vec3<Scalar> p(Scalar(0.1), Scalar(0.2), Scalar(0.3));
    EXPECT_EQ(detail::to_mesh(none, p), p);
}

// A point of the mesh's box, put into the world in rationals, lies in the world's box; and that is not much larger.
TYPED_TEST(Placements, boxes_hold_what_is_in_them) {
    using Scalar = TypeParam;
    Random random(4);
    for (int i = 0; i < 500; ++i) {
        const Pose<Scalar> pose = random_pose<Scalar>(random, std::exp(random.between(-8, 8)));
        const detail::Placement placement = detail::make_placement(pose);
        const Vec3<double> middle = std::exp(random.between(-8, 8)) * random.in_cube();
        const Vec3<double> half = (std::exp(random.between(-8, 4)) * random.in_cube()).cwiseAbs();
        detail::Box bounds{};
        for (std::size_t k = 0; k < 3; ++k) {
            bounds.low[k] = middle[Eigen::Index(k)] - half[Eigen::Index(k)];
            bounds.high[k] = middle[Eigen::Index(k)] + half[Eigen::Index(k)];
        }
        const detail::Box box = detail::box_of(placement, bounds);
        for (std::size_t k = 0; k < 3; ++k) {
            // By the matrix as it is kept; the rotation nearest to it is within 40 u (placement.h).
            mpq_class low = 0;
            mpq_class high = 0;
            mpq_class size = 0;
            for (std::size_t j = 0; j < 3; ++j) {
                const mpq_class r = placement.rotation[k][j];
                const mpq_class a = r * mpq_class(bounds.low[j]);
                const mpq_class b = r * mpq_class(bounds.high[j]);
                low += a < b ? a : b;
                high += a < b ? b : a;
                size += abs(mpq_class(bounds.low[j])) + abs(mpq_class(bounds.high[j]));
            }
            low += mpq_class(placement.translation[k]);
            high += mpq_class(placement.translation[k]);
            const mpq_class nearest = 40 * mpq_class(0x1p-53) * size;
            EXPECT_GE(low - nearest, mpq_class(box.low[k]));
            EXPECT_LE(high + nearest, mpq_class(box.high[k]));
            const mpq_class wide = mpq_class(0x1p-44) * (size + abs(mpq_class(placement.translation[k])));
            EXPECT_LE(low - mpq_class(box.low[k]), wide);
            EXPECT_LE(mpq_class(box.high[k]) - high, wide);
        }
    }
}

}  // namespace
}  // namespace pierce::test

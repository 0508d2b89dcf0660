// Poses checked and made exact, and the boxes of what they put into the world.
#include <rigid/placement.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pierce::detail {

namespace {

using Rows = std::array<Point, 3>;

Rows square_of(const Rows& x) {
    Rows out{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) out[i][j] = (x[0][i] * x[0][j] + x[1][i] * x[1][j]) + x[2][i] * x[2][j];
    return out;
}

double identity(std::size_t i, std::size_t j) { return i == j ? 1 : 0; }

// One step towards the nearest rotation.
Rows nearer(const Rows& x) {
    Rows factor = square_of(x);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) factor[i][j] = (3 * identity(i, j) - factor[i][j]) / 2;
    Rows out{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            out[i][j] = (x[i][0] * factor[0][j] + x[i][1] * factor[1][j]) + x[i][2] * factor[2][j];
    return out;
}

double determinant(const Rows& x) {
    return x[0][0] * (x[1][1] * x[2][2] - x[1][2] * x[2][1]) - x[0][1] * (x[1][0] * x[2][2] - x[1][2] * x[2][0]) +
           x[0][2] * (x[1][0] * x[2][1] - x[1][1] * x[2][0]);
}

// How far an entry of its transpose times itself may be from the identity's.
constexpr double k_not_rigid = 0x1p-14;

}  // namespace

template <class Scalar>
Placement make_placement(const Pose<Scalar>& pose) {
    Placement placement;
    bool identical = true;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        placement.translation[i] = static_cast<double>(pose.translation[row]);
        // Written so that NaN is refused.
        if (!(std::abs(placement.translation[i]) <= static_cast<double>(std::numeric_limits<Scalar>::max())))
            throw std::invalid_argument("Pose::translation is not finite");
        for (std::size_t j = 0; j < 3; ++j) {
            const auto x = static_cast<double>(pose.rotation(row, static_cast<Eigen::Index>(j)));
            placement.rotation[i][j] = x;
            identical = identical && x == identity(i, j);
        }
    }
    if (identical) {
        const bool still = placement.translation == Point{};
        placement = {Placement{}.rotation, placement.translation, still ? Stand::still : Stand::moved};
        return placement;
    }
    const Rows square = square_of(placement.rotation);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (!(std::abs(square[i][j] - identity(i, j)) <= k_not_rigid))
                throw std::invalid_argument("Pose::rotation is not one: it stretches, shears or is not finite");
    if (!(determinant(placement.rotation) > 0)) throw std::invalid_argument("Pose::rotation is not one: it mirrors");
    for (int step = 0; step < 3; ++step) placement.rotation = nearer(placement.rotation);
    placement.stand = Stand::turned;
    return placement;
}

// The middle c and the half sides h of the box are off by u of its coordinates, |R| h and R c by 4 u of their lengths
// in each coordinate, and by 40 u for R; the sums by 3 u more of what is added. All of it is below 2^-47 of the sum of
// all magnitudes.
Box box_of(const Placement& placement, const Box& bounds) {
    if (placement.stand == Stand::still) return bounds;
    Point center{};
    Point half{};
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        center[k] = bounds.low[k] / 2 + bounds.high[k] / 2;
        half[k] = bounds.high[k] / 2 - bounds.low[k] / 2;
        size += std::abs(center[k]) + half[k];
    }
    Point spread = half;
    if (placement.stand == Stand::turned)
        for (std::size_t k = 0; k < 3; ++k) {
            const Point& r = placement.rotation[k];
            spread[k] = std::abs(r[0]) * half[0] + std::abs(r[1]) * half[1] + std::abs(r[2]) * half[2];
        }
    const Point middle = out_of(placement, center);
    Box box{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double margin =
            (size + std::abs(placement.translation[k])) * 0x1p-46 + std::numeric_limits<double>::min();
        constexpr double k_infinite = std::numeric_limits<double>::infinity();
        box.low[k] = middle[k] - (spread[k] + margin);
        box.high[k] = middle[k] + (spread[k] + margin);
        // NaN is the difference of what is infinite.
        if (!(box.low[k] >= -k_infinite)) box.low[k] = -k_infinite;
        if (!(box.high[k] <= k_infinite)) box.high[k] = k_infinite;
    }
    return box;
}

template <class Scalar>
Vec3<Scalar> to_mesh(const Placement& placement, const Vec3<Scalar>& point) {
    return to_vector<Scalar>(image_of<Scalar>(placement, to_point(point)));
}
template <class Scalar>
Vec3<Scalar> to_world(const Placement& placement, const Vec3<Scalar>& point) {
    return to_vector<Scalar>(out_of(placement, to_point(point)));
}

template Vec3<float> to_mesh(const Placement&, const Vec3<float>&);
template Vec3<double> to_mesh(const Placement&, const Vec3<double>&);
template Vec3<float> to_world(const Placement&, const Vec3<float>&);
template Vec3<double> to_world(const Placement&, const Vec3<double>&);
template Placement make_placement(const Pose<float>&);
template Placement make_placement(const Pose<double>&);

}  // namespace pierce::detail

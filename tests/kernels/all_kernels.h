// The kernels by name, and exactly what each of them is asked: shared by the tests of all.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include <pierce/kernels.h>
#include <support/pairs.h>

namespace pierce::test {

/// Calls f(name, kernel) for each kernel but the exact one.
template <class Function>
void for_each_kernel(Function&& f) {
    f("bloom", kernels::bloom);
    f("baldwin_weber_12", kernels::baldwin_weber_12);
    f("baldwin_weber_9", kernels::baldwin_weber_9);
    f("moller_trumbore", kernels::moller_trumbore);
    f("cramer", kernels::cramer);
    f("mcguire", kernels::McGuire{.epsilon = 0});
    f("triangle_fan", kernels::triangle_fan);
    f("watertight", kernels::watertight);
}

template <class... Kernels>
constexpr bool k_all_are_kernels = (... && (kernels::Kernel<Kernels, float> && kernels::Kernel<Kernels, double>));
static_assert(
    k_all_are_kernels<kernels::Bloom, kernels::BaldwinWeber12, kernels::BaldwinWeber9, kernels::MollerTrumbore,
                      kernels::Cramer, kernels::McGuire, kernels::TriangleFan, kernels::Watertight, kernels::Exact>);

template <class Scalar>
Vec3<Scalar> vec(const detail::Point& p) {
    return Vec3<double>(p[0], p[1], p[2]).template cast<Scalar>();
}

template <class Kernel, class Scalar>
auto tested(const Kernel& kernel, const std::array<Vec3<Scalar>, 3>& t, const Vec3<Scalar>& from,
            const Vec3<Scalar>& to) {
    return kernel.test(kernel.prepare(t[0], t[1], t[2]), from, to);
}

/// How a pair lies, in long double: 64 bits, so that what is measured in units of a double's rounding still has three
/// digits.
struct Margins {
    template <class Scalar>
    Margins(const std::array<Vec3<Scalar>, 3>& t, const Vec3<Scalar>& p, const Vec3<Scalar>& q) {
        using V = Eigen::Matrix<long double, 3, 1>;
        const V a = t[0].template cast<long double>();
        const V from = p.template cast<long double>() - a;
        const V way = q.template cast<long double>() - p.template cast<long double>();
        const V ab = t[1].template cast<long double>() - a;
        const V ac = t[2].template cast<long double>() - a;
        const V n = ab.cross(ac);
        const long double area = n.norm();
        height_from = n.dot(from) / area;
        const long double fall = -n.dot(way) / area;
        height_to = height_from - fall;
        fraction = height_from / fall;
        const V x = from + fraction * way;
        weight[1] = x.cross(ac).dot(n) / (area * area);
        weight[2] = ab.cross(x).dot(n) / (area * area);
        weight[0] = 1 - weight[1] - weight[2];
        const long double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
        aspect = longest * longest / area;
        altitude = area / longest;
        grazing = way.norm() / std::abs(fall);
        length = way.norm();
        local = std::max({from.norm(), (from + way).norm(), longest});
        far = local;
        for (const auto& x_of : {t[0], t[1], t[2], p, q}) far = std::max(far, x_of.template cast<long double>().norm());
    }

    std::array<long double, 3> weight{};
    long double height_from, height_to, fraction;
    long double aspect;    ///< longest edge over smallest altitude
    long double altitude;  ///< the smallest
    long double grazing;   ///< 1 / cosine between the segment and the normal
    long double length;    ///< of the segment
    long double local;     ///< the largest distance between a and any of the points
    long double far;       ///< the same from the origin, if that is larger
};

}  // namespace pierce::test

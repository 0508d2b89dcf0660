// The exact single-triangle kernel: the decision contract and its values, behind the caller's floating-point
// environment.
#include <pierce/kernels/exact.h>

#include <cmath>

#include <environment.h>
#include <exact/decide.h>
#include <exact/fraction.h>

namespace pierce::kernels {

namespace {

template <class Scalar>
std::optional<Answer<Scalar>> answered(const Vertices<Scalar>& stored, const Vec3<Scalar>& from, const Vec3<Scalar>& to,
                                       Sides sides) {
    const detail::StandardArithmetic standard;
    const auto point = [](const auto& p) { return detail::Point{double{p[0]}, double{p[1]}, double{p[2]}}; };
    const detail::Path path{point(from), point(to)};
    const detail::Corners corners{point(stored.a), point(stored.b), point(stored.c)};
    for (const detail::Point& p : {path.from, path.to, corners[0], corners[1], corners[2]})
        for (const double x : p)
            if (!std::isfinite(x)) return std::nullopt;
    if (!detail::decide(path, corners, sides).hit) return std::nullopt;
    const detail::Measures measures = detail::measure(path, corners);
    return Answer<Scalar>{static_cast<Scalar>(measures.fraction), static_cast<Scalar>(measures.barycentric[1]),
                          static_cast<Scalar>(measures.barycentric[2])};
}

}  // namespace

std::optional<Answer<float>> Exact::test(const Vertices<float>& stored, const Vec3<float>& from,
                                         const Vec3<float>& to) const noexcept {
    return answered<float>(stored, from, to, sides);
}
std::optional<Answer<double>> Exact::test(const Vertices<double>& stored, const Vec3<double>& from,
                                          const Vec3<double>& to) const noexcept {
    return answered<double>(stored, from, to, sides);
}

}  // namespace pierce::kernels

// Three numbers as plain memory: the points and vectors inside of a hit. Eigen's vectors can't be copied byte by byte.
#pragma once

#include <concepts>
#include <iosfwd>

#include <pierce/types.h>

namespace pierce {

/// A point or vector as an array of three numbers, trivially copyable and without padding. It becomes a `Vec3` where
/// one is wanted, and `+ - * /`, `==`, `dot`, `cross` and `norm` work on it as on one; `vec()` has all the rest of
/// Eigen (`v.dot(hit.normal)` is `hit.normal.dot(v)`, or `v.dot(hit.normal.vec())`).
template <class Scalar>
struct Coordinates {
    /// What it becomes: a vector of Eigen's.
    using Vec = Vec3<Scalar>;

    Scalar values[3];  ///< x, y, z

    Coordinates() = default;
    /// From three numbers.
    constexpr Coordinates(Scalar x, Scalar y, Scalar z) : values{x, y, z} {}
    /// From a vector. Not implicit: `hit ? hit->point : target` could not choose.
    explicit Coordinates(const Vec& v) : values{v[0], v[1], v[2]} {}
    /// Takes the numbers of a vector.
    Coordinates& operator=(const Vec& v) { return *this = Coordinates(v); }

    /// The same numbers as a vector of Eigen's.
    [[nodiscard]] Vec vec() const { return Vec(values[0], values[1], values[2]); }
    /// The same, where one is wanted.
    operator Vec() const { return vec(); }

    /// The first number.
    [[nodiscard]] constexpr Scalar x() const { return values[0]; }
    /// The second one.
    [[nodiscard]] constexpr Scalar y() const { return values[1]; }
    /// The third one.
    [[nodiscard]] constexpr Scalar z() const { return values[2]; }
    /// Number i, from 0 to 2; not checked.
    template <std::integral Index>
    [[nodiscard]] constexpr Scalar operator[](Index i) const {
        return values[i];
    }
    template <std::integral Index>
    [[nodiscard]] constexpr Scalar& operator[](Index i) {
        return values[i];
    }
    /// Where the three numbers are.
    [[nodiscard]] constexpr Scalar* data() { return values; }
    [[nodiscard]] constexpr const Scalar* data() const { return values; }

    /// As of vectors, with one of Eigen's or of this type.
    [[nodiscard]] Scalar dot(const Vec& v) const { return vec().dot(v); }
    /// The cross product with another vector.
    [[nodiscard]] Vec cross(const Vec& v) const {
        return Vec(values[1] * v[2] - values[2] * v[1], values[2] * v[0] - values[0] * v[2],
                   values[0] * v[1] - values[1] * v[0]);
    }
    /// The length.
    [[nodiscard]] Scalar norm() const { return vec().norm(); }
    /// The square of the length.
    [[nodiscard]] Scalar squaredNorm() const { return vec().squaredNorm(); }
    /// The same in another type of number.
    template <class Other>
    [[nodiscard]] Vec3<Other> cast() const {
        return vec().template cast<Other>();
    }

    // Found for an operand of this type only; the other one may be any expression of Eigen's.
    friend Vec operator+(const Vec& a, const Vec& b) { return Vec(a[0] + b[0], a[1] + b[1], a[2] + b[2]); }
    friend Vec operator-(const Vec& a, const Vec& b) { return Vec(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }
    friend Vec operator-(const Coordinates& a) { return Vec(-a[0], -a[1], -a[2]); }
    friend Vec operator*(Scalar s, const Coordinates& a) { return Vec(s * a[0], s * a[1], s * a[2]); }
    friend Vec operator*(const Coordinates& a, Scalar s) { return Vec(a[0] * s, a[1] * s, a[2] * s); }
    friend Vec operator/(const Coordinates& a, Scalar s) { return Vec(a[0] / s, a[1] / s, a[2] / s); }
    friend bool operator==(const Vec& a, const Vec& b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }
    template <class Derived>
    friend Derived& operator+=(Eigen::MatrixBase<Derived>& v, const Coordinates& a) {
        return v += a.vec();
    }
    template <class Derived>
    friend Derived& operator-=(Eigen::MatrixBase<Derived>& v, const Coordinates& a) {
        return v -= a.vec();
    }
    template <class Char, class Traits>
    friend std::basic_ostream<Char, Traits>& operator<<(std::basic_ostream<Char, Traits>& out, const Coordinates& a) {
        return out << a.values[0] << ' ' << a.values[1] << ' ' << a.values[2];
    }
};

}  // namespace pierce

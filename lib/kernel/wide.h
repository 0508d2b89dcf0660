// Several numbers in step, for the formulas of include/pierce/kernels: one operation for all lanes, each rounded as a
// scalar one. Made of the vector types of GCC and Clang, so that it says nothing of an instruction set: the flags of
// the file that includes it do.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <pierce/kernels/watertight.h>

namespace pierce::detail {

/// A truth value for each lane: all bits of it set, or none.
template <class Scalar, std::size_t Lanes>
struct WideMask {
    using Integer = std::conditional_t<sizeof(Scalar) == 4, std::int32_t, std::int64_t>;
    typedef Integer Vector __attribute__((vector_size(sizeof(Integer) * Lanes)));

    Vector bits;

    friend WideMask operator&(const WideMask& x, const WideMask& y) { return {x.bits & y.bits}; }
    friend WideMask operator|(const WideMask& x, const WideMask& y) { return {x.bits | y.bits}; }
    [[nodiscard]] bool operator[](std::size_t lane) const { return bits[lane] != 0; }

    friend bool none(const WideMask& mask) {
        using Word =
            std::conditional_t<Lanes != 0, std::int64_t, Integer>;  // GCC takes the attribute on a dependent type only
        typedef Word Words __attribute__((vector_size(sizeof(Vector))));
        const Words words = reinterpret_cast<Words>(mask.bits);
        std::int64_t any = 0;
        for (std::size_t i = 0; i < sizeof(Vector) / 8; ++i) any |= words[i];
        return any == 0;
    }
};

template <class Scalar, std::size_t Lanes>
struct Wide {
    typedef Scalar Vector __attribute__((vector_size(sizeof(Scalar) * Lanes)));
    using Truth = WideMask<Scalar, Lanes>;
    static constexpr std::size_t lanes = Lanes;

    Vector values{};

    Wide() = default;
    explicit Wide(const Vector& v) : values(v) {}
    /// The same in all lanes.
    template <class Value>
    requires std::is_arithmetic_v<Value>
    explicit Wide(Value value) : values(Vector{} + static_cast<Scalar>(value)) {}

    [[nodiscard]] Scalar operator[](std::size_t lane) const { return values[lane]; }
    void set(std::size_t lane, Scalar value) { values[lane] = value; }

    friend Wide operator+(const Wide& x, const Wide& y) { return Wide(x.values + y.values); }
    friend Wide operator-(const Wide& x, const Wide& y) { return Wide(x.values - y.values); }
    friend Wide operator*(const Wide& x, const Wide& y) { return Wide(x.values * y.values); }
    friend Wide operator/(const Wide& x, const Wide& y) { return Wide(x.values / y.values); }
    friend Wide operator-(const Wide& x) { return Wide(-x.values); }
    friend Truth operator<(const Wide& x, const Wide& y) { return {x.values < y.values}; }
    friend Truth operator<=(const Wide& x, const Wide& y) { return {x.values <= y.values}; }
    friend Truth operator>(const Wide& x, const Wide& y) { return {x.values > y.values}; }
    friend Truth operator>=(const Wide& x, const Wide& y) { return {x.values >= y.values}; }
    friend Truth operator==(const Wide& x, const Wide& y) { return {x.values == y.values}; }

    friend Wide select(const Truth& mask, const Wide& yes, const Wide& no) {
        return Wide(mask.bits ? yes.values : no.values);
    }

    friend Wide sqrt(const Wide& x) {
        Wide root;
        for (std::size_t lane = 0; lane < Lanes; ++lane) root.values[lane] = std::sqrt(x.values[lane]);
        return root;
    }
    /// See kernels/watertight.h. Rare, so lane by lane.
    friend Wide edge_function(const Wide& p, const Wide& q, const Wide& r, const Wide& s, const Truth& refine) {
        Wide result;
        for (std::size_t lane = 0; lane < Lanes; ++lane)
            result.values[lane] = kernels::edge_function<Scalar>(p[lane], q[lane], r[lane], s[lane], refine[lane]);
        return result;
    }
};

/// Several stored forms side by side: what stands at one place in each of them becomes the lanes of one number.
/// `Narrow` and `Broad` are a kernel's stored form, or a `Triple`, over Scalar and over Wide<Scalar, Lanes>: the same
/// numbers in the same order, a column last.
template <class Broad, class Narrow, class Scalar, std::size_t Lanes>
[[nodiscard]] Broad side_by_side(const std::array<Narrow, Lanes>& forms) {
    using Number = Wide<Scalar, Lanes>;
    constexpr bool has_column = requires(Narrow narrow) { narrow.column; };
    constexpr std::size_t count = sizeof(Broad) / sizeof(Number) - (has_column ? 1 : 0);
    Broad broad;
    auto* numbers = reinterpret_cast<std::byte*>(&broad);
    for (std::size_t i = 0; i < count; ++i) {
        Number number;
        for (std::size_t lane = 0; lane < Lanes; ++lane) {
            Scalar value;
            std::memcpy(&value, reinterpret_cast<const std::byte*>(&forms[lane]) + i * sizeof(Scalar), sizeof(Scalar));
            number.set(lane, value);
        }
        std::memcpy(numbers + i * sizeof(Number), &number, sizeof(Number));
    }
    if constexpr (has_column)
        for (std::size_t lane = 0; lane < Lanes; ++lane)
            broad.column.set(lane, static_cast<Scalar>(forms[lane].column));
    return broad;
}

}  // namespace pierce::detail

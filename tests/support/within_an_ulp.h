// Whether a parameter that the library reports is as near to the true one as it promises.
#pragma once

#include <cmath>
#include <limits>

#include <gmpxx.h>

namespace pierce::test {

/// The largest number stands for all above it.
template <class Scalar>
bool within_an_ulp(Scalar value, const mpq_class& exact) {
    if (value == std::numeric_limits<Scalar>::max()) return exact >= static_cast<double>(value);
    const auto next = [&](Scalar to) { return mpq_class(static_cast<double>(std::nextafter(value, to))); };
    if (next(0) <= exact && (std::isinf(std::nextafter(value, INFINITY)) || exact <= next(INFINITY))) return true;
    return value == 0 && exact <= static_cast<double>(std::numeric_limits<Scalar>::denorm_min());
}

}  // namespace pierce::test

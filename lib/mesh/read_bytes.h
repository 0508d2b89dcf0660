// Numbers as binary files hold them, in either byte order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

#include "mesh/read_source.h"

namespace pierce::detail {

static_assert(std::endian::native == std::endian::little || std::endian::native == std::endian::big);

/// The number whose bytes start at `place`, in the given order.
template <class Number>
[[nodiscard]] Number number_at(const char* place, std::endian order) {
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), place, sizeof(Number));
    if (order != std::endian::native) {
        std::reverse(bytes.begin(), bytes.end());
    }
    return std::bit_cast<Number>(bytes);
}

/// A coordinate read from `place`, rounded to `Scalar`. Refuses what is not finite, or is not after rounding.
template <class Scalar, class Number>
[[nodiscard]] Scalar coordinate_from(Number number, const SourceFile& file, const char* place) {
    if constexpr (std::is_floating_point_v<Number>) {
        if (!std::isfinite(number)) {
            file.fail_at_byte(place,
                              std::isnan(number) ? "a coordinate is not a number (NaN)" : "a coordinate is infinite");
        }
    }
    static_assert(std::numeric_limits<Scalar>::is_iec559, "what is too large must become infinite");
    const auto coordinate = static_cast<Scalar>(number);
    if (!std::isfinite(coordinate)) {
        // Not printf, which goes by the rounding mode of the x87 unit too.
        std::array<char, 32> digits;
        const auto end = std::to_chars(digits.begin(), digits.end(), static_cast<double>(number)).ptr;
        file.fail_at_byte(place, "coordinate " + std::string(digits.begin(), end) + " does not fit in float");
    }
    return coordinate;
}

}  // namespace pierce::detail

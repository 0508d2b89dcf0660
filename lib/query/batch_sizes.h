// Whether a batch has as many places for answers as questions.
#pragma once

#include <stdexcept>
#include <string>

#include <pierce/batch.h>

namespace pierce::detail {

/// Throws std::invalid_argument, naming the call and both numbers.
inline void check_sizes(const char* call, std::size_t one, const char* of_one, std::size_t other,
                        const char* of_other) {
    if (one == other) return;
    throw std::invalid_argument(std::string(call) + ": " + std::to_string(one) + ' ' + of_one + " and " +
                                std::to_string(other) + ' ' + of_other);
}

template <class Scalar>
void check_sizes(const char* call, const Segments<Scalar>& segments, std::size_t out) {
    check_sizes(call, segments.starts().size(), "starts", segments.ends().size(), "ends");
    check_sizes(call, segments.size(), "segments", out, "places for answers");
}

template <class Scalar>
void check_sizes(const char* call, const Rays<Scalar>& rays, std::size_t out) {
    check_sizes(call, rays.origins().size(), "origins", rays.directions().size(), "directions");
    check_sizes(call, rays.size(), "rays", out, "places for answers");
}

}  // namespace pierce::detail

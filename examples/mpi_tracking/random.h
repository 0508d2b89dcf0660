// Random numbers by counter: number n of particle p is a function of p, n and the seed, so what a particle does depends
// on its number alone, whoever flies it and after whatever else.
#pragma once

#include <array>
#include <cstdint>

#include <pierce/types.h>

namespace tracking {

using Vec3 = pierce::Vec3<double>;
using Words = std::array<std::uint32_t, 4>;

/// Philox4x32-10 (Salmon, Moraes, Dror and Shaw: Parallel random numbers: as easy as 1, 2, 3, 2011).
constexpr Words philox(Words counter, std::array<std::uint32_t, 2> key) {
    const auto high = [](std::uint64_t product) { return static_cast<std::uint32_t>(product >> 32); };
    const auto low = [](std::uint64_t product) { return static_cast<std::uint32_t>(product); };
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = std::uint64_t{0xD2511F53} * counter[0], b = std::uint64_t{0xCD9E8D57} * counter[2];
        counter = {high(b) ^ counter[1] ^ key[0], low(b), high(a) ^ counter[3] ^ key[1], low(a)};
        key[0] += 0x9E3779B9;
        key[1] += 0xBB67AE85;
    }
    return counter;
}

// The known answers that the authors' Random123 comes with.
static_assert(philox({}, {}) == Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
static_assert(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
              Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});

/// The numbers of one particle. Its state is how many blocks of four words were drawn.
struct Stream {
    std::uint64_t particle = 0;
    std::uint32_t drawn = 0;

    Words next(std::uint64_t seed) {
        const auto half = [](std::uint64_t word, int k) { return static_cast<std::uint32_t>(word >> (32 * k)); };
        return philox({half(particle, 0), half(particle, 1), drawn++, 0}, {half(seed, 0), half(seed, 1)});
    }
};

/// Uniform in the cube from -1 to 1, without its sides: exact, for the words have 32 bits and doubles 53.
inline Vec3 in_cube(const Words& words) {
    const auto coordinate = [](std::uint32_t word) { return (2.0 * word + 1) * 0x1p-32 - 1; };
    return {coordinate(words[0]), coordinate(words[1]), coordinate(words[2])};
}

/// Summed in this order on every machine, which Eigen does not promise of its `squaredNorm`.
inline double squared_length(const Vec3& v) { return v.x() * v.x() + v.y() * v.y() + v.z() * v.z(); }

/// A vector with a uniform direction, by rejection: sine and cosine differ from one C library to the next, while sums,
/// products, quotients and square roots are rounded the same everywhere. Where `words` won't do, more are drawn.
inline Vec3 in_ball(Words words, Stream& stream, std::uint64_t seed) {
    for (;; words = stream.next(seed)) {
        const Vec3 v = in_cube(words);
        const double square = squared_length(v);
        if (square <= 1 && square >= 0x1p-20) return v;  // a shorter one has few bits of a direction
    }
}

}  // namespace tracking

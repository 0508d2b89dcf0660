// A fingerprint of 128 bits, for what is to be the same bit by bit. No secret: it finds accidents, not forgeries.
#pragma once

#include <bit>
#include <cstdint>
#include <cstdio>
#include <string>

namespace tracking {

struct Hash {
    std::uint64_t low = 0x243f6a8885a308d3, high = 0x13198a2e03707344;  // pi

    void add(std::uint64_t word) {
        low = mixed(low ^ word);
        high = mixed(high + word);
    }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }

    [[nodiscard]] std::string to_string() const {
        char text[33];
        std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(high),
                      static_cast<unsigned long long>(low));
        return text;
    }

    friend bool operator==(const Hash&, const Hash&) = default;

  private:
    /// A bijection in which every bit of the input changes half of the others (SplitMix64, by Steele, Lea and Flood
    /// 2014, with its increment).
    static std::uint64_t mixed(std::uint64_t z) {
        z += 0x9e3779b97f4a7c15;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }
};

}  // namespace tracking

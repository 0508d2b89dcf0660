// A fingerprint of answers: equal for equal bits, whatever padding lies between them.
#pragma once

#include <cstdint>

#include <support/expect_hit.h>

namespace pierce::test {

/// FNV-1a over 64-bit words (Fowler, Noll, Vo 1991).
class Hash {
  public:
    void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3U; }
    template <class Scalar>
    void add(const Hit<Scalar>& hit) {
        for (const std::uint64_t word :
             {std::uint64_t{hit.face}, std::uint64_t{hit.triangle}, std::uint64_t(hit.side), std::uint64_t(hit.feature),
              std::uint64_t{hit.feature_index}, std::uint64_t{hit.at_start}, std::uint64_t{bits(hit.fraction)},
              std::uint64_t{bits(hit.exact_fraction)}})
            add(word);
        for (int k = 0; k < 3; ++k) {
            add(bits(hit.point[k]));
            add(bits(hit.position[k]));
            add(bits(hit.normal[k]));
            add(bits(hit.barycentric[k]));
        }
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace pierce::test

// The floating-point environment that the library is proved for, whatever the caller's is.
#pragma once

namespace pierce::detail {

/// For as long as it lives: round to nearest, denormal numbers kept (neither flushed to zero nor read as zero), no
/// trap. Games switch flushing on for speed, and linking with -ffast-math does so for the whole program. Reads the
/// control register, and writes it only if it has to.
///
/// The compiler knows nothing of that register, and may move arithmetic across its change: everything that counts must
/// be behind a call that is not inlined ([[gnu::noinline]]).
class StandardArithmetic {
  public:
    StandardArithmetic() noexcept;
    ~StandardArithmetic();
    StandardArithmetic(const StandardArithmetic&) = delete;
    StandardArithmetic& operator=(const StandardArithmetic&) = delete;

  private:
    unsigned long long saved_;
    bool changed_ = false;
};

}  // namespace pierce::detail

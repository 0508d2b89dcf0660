// A floating-point environment that is not the standard one, for as long as it lives: what a game may have set.
#pragma once

#include <cfenv>

#include <gtest/gtest.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace pierce::test {

class Setting {
  public:
    /// `flush`: denormal numbers become zero, as results and as operands.
    Setting(int rounding, bool flush) : rounding_(rounding), flush_(flush) {
        std::fesetround(rounding);
#if defined(__SSE2__)
        if (flush) _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
    }
    ~Setting() { std::fesetenv(FE_DFL_ENV); }
    Setting(const Setting&) = delete;
    Setting& operator=(const Setting&) = delete;

    /// A call that came back must have left it as it was.
    void expect_given_back() const {
#if defined(__SSE2__)
        EXPECT_EQ(_mm_getcsr() & 0x8040U, flush_ ? 0x8040U : 0U) << "flushing is given back";
#endif
        EXPECT_EQ(std::fegetround(), rounding_) << "the rounding mode is given back";
    }

  private:
    int rounding_;
    [[maybe_unused]] bool flush_;
};

/// Calls `f(rounding, flush)` for every setting but the standard one.
template <class F>
void for_each_setting(F&& f) {
    for (const int rounding : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
        for (const bool flush : {false, true})
            if (flush || rounding != FE_TONEAREST) f(rounding, flush);
}

}  // namespace pierce::test

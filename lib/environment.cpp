// The floating-point environment that the library is proved for.
#include <environment.h>

#include <cfenv>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace pierce::detail {

namespace {

#if defined(__SSE2__)
// MXCSR (Intel SDM volume 1, 10.2.3): bits 0-5 flags, 6 denormals are zero, 7-12 masks, 13-14 rounding, 15 flush to
// zero.
constexpr unsigned k_control = 0xffc0;
constexpr unsigned k_standard = 0x1f80;

unsigned long long read() { return _mm_getcsr(); }
void write(unsigned long long value) { _mm_setcsr(static_cast<unsigned>(value)); }
#elif defined(__aarch64__)
// FPCR (Arm ARM, C5.2): bits 8-12 and 15 traps, 22-23 rounding, 24 flush to zero, 26 alternative half precision; 0, 1
// of FEAT_AFP.
constexpr unsigned long long k_control = 0x05c09f03;
constexpr unsigned long long k_standard = 0;

unsigned long long read() {
    unsigned long long value;
    asm volatile("mrs %0, fpcr" : "=r"(value));
    return value;
}
void write(unsigned long long value) { asm volatile("msr fpcr, %0" : : "r"(value)); }
#else
// Rounding only: such a machine's way of flushing denormals is not known here.
constexpr unsigned long long k_control = ~0ULL;
constexpr unsigned long long k_standard = FE_TONEAREST;

unsigned long long read() { return static_cast<unsigned long long>(std::fegetround()); }
void write(unsigned long long value) { std::fesetround(static_cast<int>(value)); }
#endif

}  // namespace

StandardArithmetic::StandardArithmetic() noexcept : saved_(read()) {
    if ((saved_ & k_control) == k_standard) return;
    changed_ = true;
    write((saved_ & ~static_cast<unsigned long long>(k_control)) | k_standard);
}

StandardArithmetic::~StandardArithmetic() {
    if (changed_) write(saved_);
}

}  // namespace pierce::detail

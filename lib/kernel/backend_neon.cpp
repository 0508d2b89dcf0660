// Four numbers at once on 64-bit Arm; see set_probe.h.
#include <arm_neon.h>

#include <kernel/table.h>

namespace pierce::detail {

namespace {

struct Neon {
    static constexpr unsigned width = 4;
    using Float = float32x4_t;
    using Mask = uint32x4_t;

    static Float all(float x) { return vdupq_n_f32(x); }
    static Float all_bits(std::uint32_t x) { return vreinterpretq_f32_u32(vdupq_n_u32(x)); }
    static Float load(const float* x) { return vld1q_f32(x); }
    static Float abs(Float x) { return vabsq_f32(x); }
    static Float max(Float x, Float y) { return vmaxq_f32(x, y); }
    static Float min(Float x, Float y) { return vminq_f32(x, y); }
    static Float multiply_add(Float x, Float y, Float z) { return vfmaq_f32(z, x, y); }
    static Mask below(Float x, Float y) { return vcltq_f32(x, y); }
    static Mask at_most(Float x, Float y) { return vcleq_f32(x, y); }
    static Mask both(Mask x, Mask y) { return vandq_u32(x, y); }
    static Mask either(Mask x, Mask y) { return vorrq_u32(x, y); }
    static unsigned bits(Mask x) {
        const uint32x4_t bit = {1, 2, 4, 8};
        return vaddvq_u32(vandq_u32(x, bit));
    }
    static Float none_where(Mask mask, Float keys) { return vbslq_f32(mask, all(__builtin_inff()), keys); }
    static Float none_but(Mask mask, Float keys) { return vbslq_f32(mask, keys, all(__builtin_inff())); }

    static Float words(const std::uint16_t* x) { return vcvtq_f32_u32(vmovl_u16(vld1_u16(x))); }
    static Float bytes(const std::uint8_t* x) {
        std::uint32_t four;
        __builtin_memcpy(&four, x, sizeof four);
        return vcvtq_f32_u32(vmovl_u16(vget_low_u16(vmovl_u8(vcreate_u8(four)))));
    }

    static constexpr unsigned words_width = 8;
    using Words = uint16x8_t;
    static Words all_words(std::uint16_t x) { return vdupq_n_u16(x); }
    static Words load_words(const std::uint16_t* x) { return vld1q_u16(x); }
    static Words above(Words x, Words y) { return vcgtq_u16(x, y); }
    static Words either(Words x, Words y) { return vorrq_u16(x, y); }
    static unsigned zeros(Words x) {
        const uint16x8_t bit = {1, 2, 4, 8, 16, 32, 64, 128};
        return vaddvq_u16(vbicq_u16(bit, x));
    }

    static Float key(Float entry, unsigned first) {
        const uint32x4_t lanes = {0, 1, 2, 3};
        const uint32x4_t places = vaddq_u32(lanes, vdupq_n_u32(first));
        return vreinterpretq_f32_u32(vorrq_u32(vandq_u32(vreinterpretq_u32_f32(entry), vdupq_n_u32(~15U)), places));
    }
    static Mask same(Float x, Float y) { return vceqq_u32(vreinterpretq_u32_f32(x), vreinterpretq_u32_f32(y)); }
    static Float least(Float x, Float y) {
        return vreinterpretq_f32_u32(vminq_u32(vreinterpretq_u32_f32(x), vreinterpretq_u32_f32(y)));
    }
    static std::uint32_t least_of(Float x) { return vminvq_u32(vreinterpretq_u32_f32(x)); }

    static Float corner_row(const float* row, float origin, float) {
        return vsubq_f32(vld1q_f32(row), vdupq_n_f32(origin));
    }
    static Float joined(float64x2_t low, float64x2_t high) {
        return vcombine_f32(vcvt_f32_f64(low), vcvt_f32_f64(high));
    }
    static Float corner_row(const double* row, double origin, double scale) {
        const float64x2_t o = vdupq_n_f64(origin);
        return joined(vmulq_n_f64(vsubq_f64(vld1q_f64(row), o), scale),
                      vmulq_n_f64(vsubq_f64(vld1q_f64(row + 2), o), scale));
    }
    static Float row_difference(const double* x, const double* y, double scale) {
        return joined(vmulq_n_f64(vsubq_f64(vld1q_f64(x), vld1q_f64(y)), scale),
                      vmulq_n_f64(vsubq_f64(vld1q_f64(x + 2), vld1q_f64(y + 2)), scale));
    }
};

}  // namespace

constinit const Backend k_neon = backend_named<Neon>("neon");

}  // namespace pierce::detail

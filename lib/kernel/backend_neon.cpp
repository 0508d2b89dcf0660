// Four triangles at once on 64-bit Arm; see lanes.h.
#include <arm_neon.h>

#include <kernel/table.h>

namespace pierce::detail {

namespace {

struct Neon {
    static constexpr unsigned width = 4;
    static constexpr unsigned boxes = 2;
    using Float = float32x4_t;

    static Float all(float x) { return vdupq_n_f32(x); }
    static Float load(const float* x) { return vld1q_f32(x); }
    static Float abs(Float x) { return vabsq_f32(x); }
    static Float max(Float x, Float y) { return vmaxq_f32(x, y); }
    static Float min(Float x, Float y) { return vminq_f32(x, y); }
    static unsigned less(Float x, Float y) {
        const uint32x4_t bit = {1, 2, 4, 8};
        return vaddvq_u32(vandq_u32(vcltq_f32(x, y), bit));
    }

    static Lanes<Neon> columns(Float r0, Float r1, Float r2, Float r3) {
        const Float xz01 = vtrn1q_f32(r0, r1);
        const Float xz23 = vtrn1q_f32(r2, r3);
        const Float y01 = vtrn2q_f32(r0, r1);
        const Float y23 = vtrn2q_f32(r2, r3);
        return {vcombine_f32(vget_low_f32(xz01), vget_low_f32(xz23)), vcombine_f32(vget_low_f32(y01), vget_low_f32(y23)),
                vcombine_f32(vget_high_f32(xz01), vget_high_f32(xz23))};
    }
    static Float fourth(Float r0, Float r1, Float r2, Float r3) {
        return vcombine_f32(vget_high_f32(vtrn2q_f32(r0, r1)), vget_high_f32(vtrn2q_f32(r2, r3)));
    }

    static constexpr unsigned rows = 4;
    static Float same_row(const float* x) { return Float{x[0], x[1], x[2], 0}; }
    static Float row(const float* const* at, unsigned i) { return vld1q_f32(at[i]); }
    static Float scaled(Float x, Float origin, float scale) { return vmulq_n_f32(vsubq_f32(x, origin), scale); }
    struct Doubles {
        float64x2_t xy, z;
    };
    static Doubles same_row(const double* x) { return {vld1q_f64(x), vdupq_n_f64(x[2])}; }
    static Doubles row(const double* const* at, unsigned i) { return {vld1q_f64(at[i]), vdupq_n_f64(at[i][2])}; }
    static Float scaled(const Doubles& x, const Doubles& origin, float scale) {
        const float64x2_t low = vmulq_n_f64(vsubq_f64(x.xy, origin.xy), scale);
        const float64x2_t high = vmulq_n_f64(vsubq_f64(x.z, origin.z), scale);
        return vcombine_f32(vcvt_f32_f64(low), vcvt_f32_f64(high));
    }

    static void settle(Double4&) {}
    static void lower(Double4& x, const Double4& y) { x = x < y ? x : y; }
    static void raise(Double4& x, const Double4& y) { x = x > y ? x : y; }
    static unsigned negative(Int4 x) {
        const int32x4_t place = {0, 1, 2, 3};
        return vaddvq_u32(vshlq_u32(vshrq_n_u32(reinterpret_cast<uint32x4_t>(x), 31), place));
    }
    static std::uint64_t pack(Int4 low, Int4 high) {
        const int16x8_t words = vcombine_s16(vqmovn_s32(reinterpret_cast<int32x4_t>(low)), vqmovn_s32(reinterpret_cast<int32x4_t>(high)));
        return vget_lane_u64(vreinterpret_u64_s8(vqmovn_s16(words)), 0);
    }
    static unsigned count_bits(std::uint64_t x) { return vaddv_u8(vcnt_u8(vcreate_u8(x))); }

    using Bytes = int8x16_t;
    static Bytes bytes(std::uint64_t x) { return vreinterpretq_s8_u64(vdupq_n_u64(x)); }
    static unsigned left(const std::uint64_t* box, Bytes above, Bytes seen) {
        const int8x16_t v = vreinterpretq_s8_u64(vld1q_u64(box));
        const uint8x16_t refused = vorrq_u8(vcgtq_s8(v, above), vreinterpretq_u8_s8(vandq_s8(v, seen)));
        const uint64x2_t free = vceqzq_u64(vreinterpretq_u64_u8(refused));
        return static_cast<unsigned>((vgetq_lane_u64(free, 0) & 1) | (vgetq_lane_u64(free, 1) & 2));
    }
    static unsigned keep(unsigned lanes, const std::uint32_t* ids, std::uint32_t* out) {
        out[0] = ids[0];
        out[lanes & 1] = ids[1];
        return (lanes & 1) + (lanes >> 1);
    }
};

}  // namespace

constinit const Backend k_neon = Kernels<Neon>::named("neon");

}  // namespace pierce::detail

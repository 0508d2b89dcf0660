// AVX-512: eight boxes at once, the rest as with AVX2; compiled with flags of its own (lib/CMakeLists.txt), see lanes.h.
#include <kernel/avx2.h>
#include <kernel/table.h>

namespace pierce::detail {

namespace {

struct Avx512 : Avx2 {
    static constexpr unsigned boxes = 8;

    using Bytes = __m512i;
    static Bytes bytes(std::uint64_t x) { return _mm512_set1_epi64(static_cast<long long>(x)); }
    static unsigned left(const std::uint64_t* box, Bytes above, Bytes seen) {
        const __m512i v = _mm512_loadu_si512(box);
        // A byte that is larger leaves a negative one, as the difference saturates.
        const __m512i larger = _mm512_subs_epi8(above, v) & _mm512_set1_epi8(-128);
        return _mm512_testn_epi64_mask(larger | (v & seen), _mm512_set1_epi64(-1));
    }
    static unsigned keep(unsigned lanes, const std::uint32_t* ids, std::uint32_t* out) {
        const __m256i some = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), _mm256_maskz_compress_epi32(static_cast<__mmask8>(lanes), some));
        return count_bits(lanes);
    }
};

}  // namespace

constinit const Backend k_avx512 = Kernels<Avx512, Avx2, Four>::named("avx512");

}  // namespace pierce::detail

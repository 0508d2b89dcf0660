// One triangle at a time, for machines whose instruction set has no file of its own, and to compare the others with; see lanes.h.
#include <kernel/backends.h>
#include <kernel/lanes.h>

namespace pierce::detail {

namespace {

struct Plain {
    static constexpr unsigned width = 1;
    static constexpr unsigned boxes = 1;
    using Float = float;

    static Float all(float x) { return x; }
    static Float abs(Float x) { return x < 0 ? -x : x; }
    static Float max(Float x, Float y) { return x > y ? x : y; }
    static Float min(Float x, Float y) { return x < y ? x : y; }
    static unsigned less(Float x, Float y) { return x < y ? 1 : 0; }

    template <class Scalar>
    static Lanes<Plain> relative(const Scalar* const* at, const Scalar* origin, float scale) {
        const auto difference = [&](unsigned k) { return static_cast<float>((at[0][k] - origin[k]) * Scalar{scale}); };
        return {difference(0), difference(1), difference(2)};
    }

    using Bytes = std::uint64_t;
    static Bytes bytes(std::uint64_t x) { return x; }
    static unsigned left(const std::uint64_t* box, Bytes above, Bytes seen) {
        if ((*box & seen) != 0) return 0;
        for (int place = 0; place < 64; place += 8)
            if (static_cast<signed char>(*box >> place & 0xff) > static_cast<signed char>(above >> place & 0xff)) return 0;
        return 1;
    }
};

unsigned cull_plain(const std::uint64_t* boxes, const std::uint32_t* ids, unsigned count, std::uint64_t above, std::uint64_t seen,
                    std::uint32_t* out) {
    return cull<Plain>(boxes, ids, count, above, seen, out);
}

template <class Scalar>
unsigned refine_plain(const Probe<Scalar>& probe, const Scalar* corners, const std::uint32_t* ids, unsigned count, std::uint32_t* out) {
    return refine<Plain>(probe, corners, ids, count, out);
}

}  // namespace

const Backend k_plain = {"plain", cull_plain, refine_plain<float>, refine_plain<double>};

}  // namespace pierce::detail

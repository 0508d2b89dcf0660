// Runs the kernels for 64-bit Arm and the plain ones side by side, without anything that a cross compiler would have to be given: what one
// leaves, the other leaves, but for triangles so close that the last bits of a bound decide.
#include <cstdio>
#include <random>

#include <kernel/backends.h>

namespace {

using namespace pierce::detail;

std::mt19937_64 engine(1);
double between(double low, double high) { return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53; }

int cull_differs() {
    int left = 0;
    for (int round = 0; round < 20'000; ++round) {
        const auto count = static_cast<unsigned>(engine() % 129);
        const std::uint64_t few = round % 2 == 0 ? 0x0303030303030303 : 0x7f7f7f7f7f7f7f7f;  // few values, often equal, or many
        std::uint64_t boxes[128 + 7];
        std::uint32_t ids[128];
        for (std::uint64_t& box : boxes) box = engine() & engine() & few;
        for (std::uint32_t& id : ids) id = static_cast<std::uint32_t>(engine());
        const std::uint64_t above = (engine() | engine()) & few;
        const std::uint64_t seen = round % 3 == 0 ? std::uint64_t{1} << (24 + 32 * (round % 2)) : 0;
        std::uint32_t neon[136];
        std::uint32_t plain[136];
        const unsigned found = k_neon.cull(boxes, ids, count, above, seen, neon);
        if (found != k_plain.cull(boxes, ids, count, above, seen, plain)) return 1;
        for (unsigned i = 0; i < found; ++i)
            if (neon[i] != plain[i]) return 1;
        left += static_cast<int>(found);
    }
    std::printf("%d boxes left\n", left);
    return left > 10'000 ? 0 : 1;
}

template <class Scalar>
int refine_differs() {
    constexpr unsigned k_count = 13;
    int left = 0;
    int refused = 0;
    int differing = 0;
    for (int round = 0; round < 20'000; ++round) {
        Scalar corners[9 * k_count + 1];
        for (Scalar& x : corners) x = static_cast<Scalar>(between(-1, 1));
        Probe<Scalar> probe{};
        for (unsigned k = 0; k < 3; ++k) {
            probe.ray.origin[k] = static_cast<Scalar>(between(-1, 1));
            probe.ray.direction[k] = static_cast<float>(between(-2, 2));
        }
        probe.scale = 1;
        probe.ray.direction[3] = round % 2 == 0 ? 1e-7F : 1e-6F;
        probe.ends = round % 2 == 0 ? 1 : 0;
        probe.unit = 0x1p-24F;
        probe.front = round % 3 != 0 ? ~0U : 0U;
        probe.back = round % 3 != 1 ? ~0U : 0U;
        std::uint32_t ids[k_count + 8];
        for (unsigned i = 0; i < k_count; ++i) ids[i] = (i * 5 + 3) % k_count;
        const auto count = static_cast<unsigned>(engine() % (k_count + 1));
        std::uint32_t neon[k_count + 1];
        std::uint32_t plain[k_count + 1];
        const unsigned found = k_neon.refine<Scalar>(probe, corners, ids, count, neon);
        const unsigned expected = k_plain.refine<Scalar>(probe, corners, ids, count, plain);
        left += static_cast<int>(found);
        refused += static_cast<int>(count - found);
        bool same = found == expected;
        for (unsigned i = 0; same && i < found; ++i) same = neon[i] == plain[i];
        differing += same ? 0 : 1;

        // Each triangle with a ray of its own; here the list has places.
        Ray<Scalar> rays[3] = {probe.ray, probe.ray, probe.ray};
        for (unsigned k = 0; k < 3; ++k) rays[1].direction[k] = -rays[1].direction[k];
        rays[2].origin[round % 3] += Scalar{0.5};
        std::uint32_t queries[k_count + 8];
        for (unsigned i = 0; i < count; ++i) queries[i] = (i + static_cast<unsigned>(round)) % 3;
        const unsigned many = k_neon.of<Scalar>().refine_many(probe, rays, corners, ids, queries, count, neon);
        same = many == k_plain.of<Scalar>().refine_many(probe, rays, corners, ids, queries, count, plain);
        for (unsigned i = 0; same && i < many; ++i) same = neon[i] == plain[i];
        differing += same ? 0 : 1;
    }
    std::printf("%d triangles left, %d refused; %d lists differ\n", left, refused, differing);
    return left > 2000 && refused > 10'000 && differing < 5 ? 0 : 1;
}

}  // namespace

int main() { return cull_differs() | refine_differs<float>() | refine_differs<double>(); }

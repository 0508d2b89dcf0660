// Runs the kernels for 64-bit Arm and the plain ones side by side, without anything that a cross compiler would have to
// be given: what one leaves, the other leaves, but for triangles and boxes so close that the last bits of a bound
// decide.
#include <cstdio>
#include <random>

#include <kernel/backend.h>

namespace {

using namespace pierce::detail;

std::mt19937_64 engine(1);
double between(double low, double high) { return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53; }

Frame unit_frame() {
    Frame frame;
    frame.step = 0x1p-15;
    for (int k = 0; k < 3; ++k) frame.high[k] = 1;
    frame.noise = 1e-9;
    return frame;
}

template <class Scalar>
struct Probes {
    Probe<Scalar> neon;
    Probe<Scalar> plain;

    explicit Probes(const Frame& frame, float short_way = 0) {
        double from[3];
        double to[3];
        const double far = engine() % 4 == 0 ? 100 : 1;  // some are clipped
        for (int k = 0; k < 3; ++k) {
            from[k] = between(-far, 1 + far);
            to[k] = engine() % 8 == 0 ? between(-far, 1 + far) : between(0, 1);
        }
        const bool front = engine() % 3 == 0;
        const bool back = !front && engine() % 2 == 0;
        one = k_neon.of<Scalar>().set_probe(frame, from, to, false, front, back, short_way, neon);
        other = k_plain.of<Scalar>().set_probe(frame, from, to, false, front, back, short_way, plain);
    }
    bool one;
    bool other;
};

template <class Scalar>
int test_cluster_differs() {
    const Frame frame = unit_frame();
    int left = 0;
    int refused = 0;
    int differing = 0;
    for (int round = 0; round < 40'000; ++round) {
        Scalar records[k_row_count * k_most_in_cluster + k_beyond_records] = {};
        const auto count = static_cast<unsigned>(1 + engine() % k_most_in_cluster);
        for (unsigned i = 0; i < 9 * count; ++i) records[i] = static_cast<Scalar>(between(0, 1));
        const Probes<Scalar> probes(frame);
        if (probes.one != probes.other) return 1;
        if (!probes.one) continue;
        const float limit = round % 2 == 0 ? 1 : static_cast<float>(between(0, 1));
        const unsigned found = k_neon.of<Scalar>().test_cluster(probes.neon, records, cluster_ref(0, count), limit);
        const unsigned expected =
            k_plain.of<Scalar>().test_cluster(probes.plain, records, cluster_ref(0, count), limit);
        if (found >> count != 0) return 1;
        left += __builtin_popcount(found);
        refused += static_cast<int>(count) - __builtin_popcount(found);
        differing += found == expected ? 0 : 1;
    }
    std::printf("%d triangles left, %d refused; %d clusters differ\n", left, refused, differing);
    return left > 2000 && refused > 10'000 && differing < 5 ? 0 : 1;
}

struct Visited {
    std::uint32_t order[16];
    unsigned count = 0;
};

float visit(void* self, std::uint32_t cluster, unsigned lanes) {
    auto& visited = *static_cast<Visited*>(self);
    if (visited.count < 16 && lanes == 1) visited.order[visited.count++] = first_of(cluster);
    return 1;
}

// One node; records of NaN are not refused, so that the boxes decide.
template <class AnyNode, class Bound>
int traverse_differs() {
    const Frame frame = unit_frame();
    constexpr bool k_coarse = sizeof(Bound) == 1;
    constexpr int k_steps = k_coarse ? 255 : 32768;
    float records[k_row_count * 16 + k_beyond_records];
    for (float& x : records) x = __builtin_nanf("");
    int left = 0;
    int differing = 0;
    for (int round = 0; round < 40'000; ++round) {
        AnyNode node{};
        for (unsigned i = 0; i < 16; ++i) {
            node.child[i] = cluster_ref(i, 1);
            for (int k = 0; k < 3; ++k) {
                const int low = static_cast<int>(between(0, 0.6 * k_steps));
                node.bounds[2 * k][i] = static_cast<Bound>(low);
                node.bounds[2 * k + 1][i] = static_cast<Bound>(low + between(0, 0.4 * k_steps));
            }
        }
        if constexpr (k_coarse)
            for (float& step : node.step) step = 1.0F / 256;
        Probes<float> probes(frame, !k_coarse && engine() % 2 == 0 ? 100.0F : 0.0F);  // or by the box around it
        if (!probes.one || !probes.other) continue;
        const TreeView tree{&node, 0, k_coarse};
        Visited neon;
        Visited plain;
        k_neon.of<float>().traverse(tree, records, probes.neon, 1, visit, &neon);
        k_plain.of<float>().traverse(tree, records, probes.plain, 1, visit, &plain);
        left += static_cast<int>(plain.count);
        bool same = neon.count == plain.count;
        for (unsigned i = 0; same && i < neon.count; ++i) same = neon.order[i] == plain.order[i];
        differing += same ? 0 : 1;
    }
    std::printf("%d boxes left; %d nodes differ\n", left, differing);
    return left > 10'000 && differing < 20 ? 0 : 1;
}

}  // namespace

int main() {
    return test_cluster_differs<float>() | test_cluster_differs<double>() | traverse_differs<Node, std::uint16_t>() |
           traverse_differs<CoarseNode, std::uint8_t>();
}

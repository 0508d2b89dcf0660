// The wide run: the same formulas over eight pairs a step, stored side by side. The one file that is compiled for AVX2.
#include <memory>

#include <kernel/wide.h>

#include "embree_style.h"
#include "table1.h"

namespace pierce::bench {

namespace {

constexpr std::size_t k_lanes = 8;
using Number = detail::Wide<float, k_lanes>;
using Ends = kernels::Triple<Number>;

template <class Broad, class Narrow, class At>
std::vector<Broad> in_blocks(std::size_t count, At&& at) {
    std::vector<Broad> blocks;
    blocks.reserve((count + k_lanes - 1) / k_lanes);
    for (std::size_t i = 0; i < count; i += k_lanes) {
        std::array<Narrow, k_lanes> forms;
        for (std::size_t lane = 0; lane < k_lanes; ++lane) forms[lane] = at(std::min(i + lane, count - 1));
        blocks.push_back(detail::side_by_side<Broad, Narrow, float, k_lanes>(forms));
    }
    return blocks;
}

/// The ends of the segments in blocks, shared by all kernels.
struct Segments {
    explicit Segments(const Pairs& pairs)
        : count(pairs.size()),
          from(in_blocks<Ends, kernels::Triple<float>>(count, [&](std::size_t i) { return pairs.from[i]; })),
          to(in_blocks<Ends, kernels::Triple<float>>(count, [&](std::size_t i) { return pairs.to[i]; })) {}
    std::size_t count;
    std::vector<Ends> from;
    std::vector<Ends> to;
};

template <class Kernel>
void enter(Contest& contest, const std::string& name, const Kernel& kernel, const Pairs& pairs,
           const std::shared_ptr<Segments>& segments) {
    using Narrow = typename Kernel::template Stored<float>;
    using Broad = typename Kernel::template Stored<Number>;
    auto stored = std::make_shared<std::vector<Broad>>(in_blocks<Broad, Narrow>(pairs.size(), [&](std::size_t i) {
        const auto& t = pairs.triangles[i];
        return kernel.prepare(t[0], t[1], t[2]);
    }));
    contest.emplace_back(name, [stored, kernel, segments] {
        Number hits{};
        Number fraction{};
        Number u{};
        Number v{};
        Sums sums;
        for (std::size_t i = 0; i < stored->size(); ++i) {
            const auto tested = kernel.evaluate((*stored)[i], segments->from[i], segments->to[i]);
            const auto counted = [&](const Number& x) { return select(tested.hit, x, Number{}); };
            hits = hits + counted(Number(1));
            fraction = fraction + counted(tested.fraction);
            u = u + counted(tested.u);
            v = v + counted(tested.v);
            if (i % 4096 != 4095 && i + 1 != stored->size()) continue;  // before single precision runs out of digits
            for (std::size_t lane = 0; lane < k_lanes; ++lane) {
                sums.hits += static_cast<std::size_t>(hits[lane]);
                sums.fraction += double{fraction[lane]};
                sums.u += double{u[lane]};
                sums.v += double{v[lane]};
            }
            hits = fraction = u = v = Number{};
        }
        return sums;
    });
}

/// Reads what Bloom's does, 12 numbers and the ends, a register of each, and decides nothing: memory's share.
struct WideDummy : kernels::Bloom {
    [[nodiscard]] static kernels::Tested<Number> evaluate(const Stored<Number>& t, const Ends& from, const Ends& to) {
        Number sum = from[0] + from[1] + from[2] + to[0] + to[1] + to[2];
        const auto* numbers = reinterpret_cast<const Number*>(&t);
        for (std::size_t i = 0; i < sizeof t / sizeof(Number); ++i) sum = sum + numbers[i];
        return {sum > Number(1e30F)};
    }
};

}  // namespace

Contest wide_contest(const Pairs& pairs) {
    Contest contest;
    if (__builtin_cpu_supports("avx2") == 0) return contest;
    const auto segments = std::make_shared<Segments>(pairs);
    enter(contest, "dummy", WideDummy{}, pairs, segments);
    enter(contest, "moller_trumbore", kernels::MollerTrumbore{}, pairs, segments);
    enter(contest, "embree_style", EmbreeStyle{}, pairs, segments);
    enter(contest, "bloom", kernels::Bloom{}, pairs, segments);
    enter(contest, "baldwin_weber_12", kernels::BaldwinWeber12{}, pairs, segments);
    enter(contest, "baldwin_weber_9", kernels::BaldwinWeber9{}, pairs, segments);
    enter(contest, "cramer", kernels::Cramer{}, pairs, segments);
    enter(contest, "mcguire", kernels::McGuire{.epsilon = 0}, pairs, segments);
    enter(contest, "watertight", kernels::Watertight{}, pairs, segments);
    // No fan: it stores several triangles, and what pays for that, the turn from one to the next, is not there with
    // one; a wide fan of n would also need pairs whose eight fans all have n triangles. With one it would be another
    // Baldwin-Weber of 12 numbers.
    return contest;
}

}  // namespace pierce::bench

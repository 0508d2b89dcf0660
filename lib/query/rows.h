// All hits of many segments or rays, as compressed rows.
#pragma once

#include <query/batch_sizes.h>
#include <query/parts.h>
#include <query/ways.h>

namespace pierce::detail {

/// `Asked`: Segments or Rays.
template <class Asked>
void check_rows(const Asked& asked, std::span<const std::size_t> offsets) {
    check_sizes("all_hits", asked, asked.size());
    check_sizes("all_hits", asked.size() + 1, "ends of rows", offsets.size(), "offsets");
}

/// What `CollisionMesh::all_hits` of a batch says. `impl` is that of a mesh or a world, `Answer` Hit or WorldHit
/// (along.h).
template <class Impl, class Scalar, class Answer, class Options>
std::size_t all_rows(const Impl& impl, const Ways<Scalar>& ways, std::span<std::size_t> offsets, std::span<Answer> hits,
                     const Options& options, const Executor& executor) {
    offsets[0] = 0;
    const bool nothing = asks_nothing(options);
    const auto hits_of = [&](std::size_t i, std::span<Answer> row, QueryCounters& counters) {
        return ways.with(i, [&](const auto& way) { return all_hits(impl.scene, way, row, options, counters); });
    };
    // Each row's length is put where the row ends.
    in_parts(
        ways.size(), options.counters, executor, [&](std::size_t count) { impl.count_invalid(count); },
        [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
            for (std::size_t i = first; i < last; ++i) {
                const bool asked = ways.is_valid(i);
                invalid += asked ? 0 : 1;
                offsets[i + 1] = asked && !nothing ? hits_of(i, {}, counters) : 0;
            }
            return std::size_t{0};
        });
    for (std::size_t i = 0; i < ways.size(); ++i) offsets[i + 1] += offsets[i];
    if (hits.empty() || offsets.back() == 0) return offsets.back();
    in_parts(
        ways.size(), options.counters, executor, [](std::size_t) {},
        [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t&) {
            counters.queries = 0;  // counted before
            for (std::size_t i = first; i < last && offsets[i + 1] <= hits.size(); ++i) {
                const std::span row = hits.subspan(offsets[i], offsets[i + 1] - offsets[i]);
                if (!row.empty()) hits_of(i, row, counters);
            }
            return std::size_t{0};
        });
    return offsets.back();
}

}  // namespace pierce::detail

// Many moves in one call.
#pragma once

#include <pierce/response.h>
#include <query/batch_sizes.h>
#include <query/parts.h>

namespace pierce::detail {

/// `move(i, contacts, counters)`: that of number i, which counts its own queries. Returns how many met something.
template <class Scalar, class CountInvalid, class MoveOne>
std::size_t move_all(const char* call, const PointsView<Scalar>& positions, const PointsView<Scalar>& velocities,
                     std::span<Move<Scalar>> out, const MoveOptions<Scalar>& options, const Executor& executor,
                     std::span<MoveContact<Scalar>> contacts, CountInvalid&& count_invalid, MoveOne&& move) {
    check_sizes(call, positions.size(), "positions", velocities.size(), "velocities");
    check_sizes(call, positions.size(), "positions", out.size(), "places for answers");
    if (!options.radii.empty()) check_sizes(call, positions.size(), "positions", options.radii.size(), "radii");
    if (out.empty()) return 0;
    const std::size_t room = contacts.size() / out.size();
    return in_parts(out.size(), options.query.counters, executor, count_invalid,
                    [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
                        counters.queries = 0;  // a move counts its own
                        std::size_t met = 0;
                        for (std::size_t i = first; i < last; ++i) {
                            out[i] = move(i, contacts.subspan(i * room, room), counters);
                            if (out[i].contacts > 0) ++met;
                            if (out[i].state == MoveState::invalid) ++invalid;
                        }
                        return met;
                    });
}

}  // namespace pierce::detail

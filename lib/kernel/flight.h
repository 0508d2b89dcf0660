// Queries in flight, as those who ask see them: where segments come from, and where what they find goes.
#pragma once

#include <kernel/probe.h>

namespace pierce::detail {

/// As many as hide the time that memory takes; 8 and 32 are no faster.
constexpr unsigned k_flights = 16;
/// Groups of children that a query in flight can keep. In a tree that has more nodes on a path, the queries of a batch
/// go one by one. (Trees of ten million faces have 10.)
constexpr unsigned k_flight_depth = 16;

/// Where queries in flight come from, and where what they find goes. `slot` is a number below k_flights.
template <class Scalar>
struct Flight {
    void* self;
    /// Makes the next query's segment ready; false: there is none.
    bool (*next)(void* self, unsigned slot, Probe<Scalar>& probe, float& limit);
    /// As Visit.
    float (*visit)(void* self, unsigned slot, std::uint32_t cluster, unsigned lanes);
    void (*finish)(void* self, unsigned slot);
};

}  // namespace pierce::detail

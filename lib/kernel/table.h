// The table of one instruction set's kernels.
#pragma once

#include <kernel/backend.h>
#include <kernel/run_flight.h>
#include <kernel/set_probe.h>
#include <kernel/traverse.h>

namespace pierce::detail {

namespace {

/// `Flights`: what queries in flight enter nodes with.
template <class Wide, class Flights, class Scalar>
struct KernelsOf {
    static bool make(const Frame& frame, const double* from, const double* to, bool ray, bool front_only,
                     bool back_only, float short_way, Probe<Scalar>& probe) {
        return set_probe<Wide>(frame, from, to, ray, front_only, back_only, short_way, probe);
    }
    static void walk(const TreeView& tree, const Scalar* records, Probe<Scalar>& probe, float limit, Visit visit,
                     void* self) {
        traverse<Wide>(tree, records, probe, limit, visit, self);
    }
    static void go(const TreeView& tree, const Scalar* records, const Flight<Scalar>& flight) {
        fly<Flights, Wide>(tree, records, flight);
    }
    static unsigned test(const Probe<Scalar>& probe, const Scalar* records, ClusterRef cluster, float limit) {
        return test_cluster<Wide>(probe, records, cluster, limit);
    }
    static constexpr ScalarKernels<Scalar> table() { return {make, walk, go, test}; }
};

template <class Wide, class Flights = Wide>
constexpr Backend backend_named(const char* name, const Narrow& narrow = k_narrow) {
    return {{KernelsOf<Wide, Flights, float>::table(), KernelsOf<Wide, Flights, double>::table()}, name, &narrow};
}

}  // namespace

}  // namespace pierce::detail

// The table of one instruction set's kernels.
#pragma once

#include <kernel/backend.h>
#include <kernel/set_probe.h>
#include <kernel/traverse.h>

namespace pierce::detail {

namespace {

template <class Wide, class Scalar>
struct KernelsOf {
    static bool make(const Frame& frame, const double* from, const double* to, bool front_only, bool back_only, Probe<Scalar>& probe) {
        return set_probe<Wide>(frame, from, to, front_only, back_only, probe);
    }
    static void walk(const TreeView& tree, const Scalar* records, Probe<Scalar>& probe, float limit, Visit visit, void* self) {
        traverse<Wide>(tree, records, probe, limit, visit, self);
    }
    static unsigned test(const Probe<Scalar>& probe, const Scalar* records, ClusterRef cluster, float limit) {
        return test_cluster<Wide>(probe, records, cluster, limit);
    }
    static constexpr ScalarKernels<Scalar> table() { return {make, walk, test}; }
};

template <class Wide>
constexpr Backend backend_named(const char* name, const Refine& refine = k_refine) {
    return {name, KernelsOf<Wide, float>::table(), KernelsOf<Wide, double>::table(), &refine};
}

}  // namespace

}  // namespace pierce::detail

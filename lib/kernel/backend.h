// The wide kernels of an instruction set, as a table of functions: each set has a file of its own, compiled with flags
// of its own.
#pragma once

#include <cluster/record.h>
#include <kernel/flight.h>
#include <kernel/narrow.h>
#include <kernel/per_scalar.h>
#include <kernel/probe.h>
#include <node.h>

namespace pierce::detail {

template <class Scalar>
struct ScalarKernels {
    /// Makes a segment ready. False: it certainly touches nothing.
    bool (*set_probe)(const Frame& frame, const double* from, const double* to, bool ray, bool front_only,
                      bool back_only, float short_way, Probe<Scalar>& probe);
    /// Visits the clusters of which triangles may be hit at a parameter up to `limit`, nearest first (traverse.h);
    /// counts in the probe.
    void (*traverse)(const TreeView& tree, const Scalar* records, Probe<Scalar>& probe, float limit, Visit visit,
                     void* self);
    /// Traversals of many segments (flight.h).
    void (*fly)(const TreeView& tree, const Scalar* records, const Flight<Scalar>& flight);
    /// The triangles of one cluster that may be hit (cluster_test.h), a bit for each.
    unsigned (*test_cluster)(const Probe<Scalar>& probe, const Scalar* records, ClusterRef cluster, float limit);
};

struct Backend : PerScalar<ScalarKernels> {
    const char* name;
    const Narrow* narrow;
};

// One for each file backend_*.cpp.
extern const Backend k_sse2;
extern const Backend k_avx2;
extern const Backend k_avx512;
extern const Backend k_neon;
extern const Backend k_plain;

}  // namespace pierce::detail

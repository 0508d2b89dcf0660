// Which columns are asked which set of segments: all of them everywhere would take hours.
#pragma once

#include <algorithm>
#include <array>

#include "bench_meshes.h"
#include "column.h"
#include "segment_sets.h"

namespace pierce::bench {

struct Plan {
    bool quick = false;

    /// Bullet and CGAL, the robust and the low scene, and double: not needed for how time grows with faces.
    [[nodiscard]] bool all_columns(const BenchMesh& mesh) const {
        return mesh.kind != MeshKind::sphere || (!quick && mesh.divisions < 1000);
    }

    [[nodiscard]] bool wanted(const BenchMesh& mesh, SegmentSet set) const {
        return mesh.kind != MeshKind::sphere || !quick || set == SegmentSet::short_02 || set == SegmentSet::short_1 ||
               set == SegmentSet::medium || set == SegmentSet::aimed || set == SegmentSet::cloud;
    }

    [[nodiscard]] bool wanted(SegmentSet set, std::string_view name) const {
        const bool is_short = set == SegmentSet::short_02 || set == SegmentSet::short_1;
        const bool is_long = set == SegmentSet::aimed || set == SegmentSet::random;
        constexpr std::array everywhere = {column::pierce, column::pierce_batch, column::fronts, column::fronts_batch,
                                           column::grid,   column::grid_batch,   column::embree};
        constexpr std::array any = {column::pierce_any, column::pierce_any_batch, column::embree_any};
        constexpr std::array slow = {column::bullet, column::cgal_any, column::cgal_first};
        const auto among = [&](const auto& names) {
            return std::find(names.begin(), names.end(), name) != names.end();
        };
        if (among(everywhere)) return true;
        if (among(any)) return !quick || is_short || is_long;
        if (among(slow)) return is_short || (!quick && set != SegmentSet::random);
        return !quick || set == SegmentSet::short_1 || set == SegmentSet::aimed;
    }
};

}  // namespace pierce::bench

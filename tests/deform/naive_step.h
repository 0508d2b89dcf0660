// The naive twin of a step: no broadphase, no order of visits.
#pragma once

#include <optional>
#include <vector>

#include <motion/moving.h>
#include <pierce/batch.h>
#include <pierce/options.h>
#include <pierce/triangle_soup.h>
#include <point.h>

namespace pierce::test {

/// Every triangle decided by lib/motion, the first taken: no broadphase, no order of visits.
template <class Scalar>
struct NaiveStep {
    TriangleSoup<Scalar> soup;
    std::vector<Vec3<Scalar>> after;

    struct Found {
        std::uint32_t triangle;
        detail::MovingTriangle corners;
        detail::Impact impact;
    };
    [[nodiscard]] std::optional<Found> first(const Segment<Scalar>& way, const QueryOptions& options) const {
        std::optional<Found> best;
        const detail::MovingPoint point{{detail::to_point(way.from), detail::to_point(way.to)}};
        const auto contact = detail::rule_of(options.sides);
        for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) {
            if (!options.face_mask.empty() && options.face_mask[i] == 0) continue;
            Found found{i, {}, {}};
            for (std::size_t k = 0; k < 3; ++k) {
                found.corners.at[0][k] = detail::to_point(soup.positions[soup.triangles[i][k]]);
                found.corners.at[1][k] = detail::to_point(after[soup.triangles[i][k]]);
            }
            found.impact = detail::strikes(point, found.corners, options.sides);
            if (!found.impact.hit) continue;
            if (options.max_fraction < 1 &&
                detail::compare_time(point, contact, found.corners, found.impact, options.max_fraction) > 0)
                continue;
            if (!best ||
                detail::compare_impacts(point, contact, found.corners, found.impact, best->corners, best->impact) < 0)
                best = found;
        }
        return best;
    }
};

}  // namespace pierce::test

// The naive twin of CollisionMesh: the same interface with no grid and no filter. Every triangle is decided in exact
// arithmetic; the only shortcut compares the boxes of segment and triangle, which no rounding can touch.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include <pierce/hit.h>
#include <pierce/mesh_view.h>
#include <pierce/options.h>
#include <query/place.h>
#include <query/report.h>
#include <query/values.h>
#include <support/boxes.h>

namespace pierce::test {

template <class Scalar>
class NaiveMesh {
  public:
    explicit NaiveMesh(const MeshView<Scalar>& mesh) {
        double largest = 0;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            detail::Corners corners;
            for (std::size_t k = 0; k < 3; ++k) corners[k] = detail::to_point(mesh.positions[mesh.triangles[i][k]]);
            if (!detail::has_zero_area(corners))
                for (const detail::Point& p : corners)
                    for (const double x : p) largest = std::max(largest, std::abs(x));
            corners_.push_back(corners);
            faces_.push_back(mesh.face_of(i));
        }
        grain_ = detail::grain_of<Scalar>(largest);
    }

    [[nodiscard]] std::optional<Hit<Scalar>> first_hit(const Segment<Scalar>& segment,
                                                       const QueryOptions& options = {}) const {
        const std::vector<Found> found = hits(path_of(segment), options);
        if (found.empty()) return std::nullopt;
        return reported(path_of(segment), found, 0, options);
    }

    [[nodiscard]] bool any_hit(const Segment<Scalar>& segment, const QueryOptions& options = {}) const {
        return !hits(path_of(segment), options).empty();
    }

    std::size_t all_hits(const Segment<Scalar>& segment, std::span<Hit<Scalar>> out,
                         const QueryOptions& options = {}) const {
        const std::vector<Found> found = hits(path_of(segment), options);
        const detail::Path path = path_of(segment);
        for (std::size_t i = 0; i < std::min(found.size(), out.size()); ++i) {
            out[i] = reported(path, found, i, options);
            if (i == 0) continue;
            const Scalar before = out[i - 1].exact_fraction;
            const bool equal = order(path, found[i - 1].triangle, found[i].triangle) == 0;
            out[i].exact_fraction = equal ? before : std::max(before, out[i].exact_fraction);
        }
        return found.size();
    }

  private:
    struct Found {
        std::uint32_t triangle;
        detail::Decision decision;
    };

    // Plain arithmetic, whatever the library uses on this machine.
    static const detail::NarrowKernels<Scalar>& narrow() { return detail::k_narrow.of<Scalar>(); }

    static detail::Path path_of(const Segment<Scalar>& segment) {
        return {detail::to_point(segment.from), detail::to_point(segment.to)};
    }

    [[nodiscard]] int order(const detail::Path& path, std::uint32_t x, std::uint32_t y) const {
        return detail::compare_fractions(path, corners_[x], corners_[y]);
    }

    // In order of (fraction, face, triangle).
    [[nodiscard]] std::vector<Found> hits(const detail::Path& path, const QueryOptions& options) const {
        std::vector<Found> found;
        for (std::uint32_t i = 0; i < corners_.size(); ++i) {
            if (boxes_apart(path, corners_[i])) continue;
            const detail::Decision decision = detail::decide(path, corners_[i], options.sides);
            if (!decision.hit || !detail::fraction_at_most(path, corners_[i], options.max_fraction)) continue;
            if (!options.face_mask.empty() &&
                (faces_[i] >= options.face_mask.size() || options.face_mask[faces_[i]] == 0))
                continue;
            if (options.accept) {
                QueryCounters unused;
                detail::Measured measured;
                detail::measure_path<Scalar>(corners_[i], path, measured);
                const detail::Measures m = detail::fine_measures(narrow(), measured, path, decision, unused);
                if (!options.accept({faces_[i],
                                     i,
                                     decision.side,
                                     decision.feature,
                                     decision.feature_index,
                                     decision.at_start,
                                     m.fraction,
                                     {m.barycentric[0], m.barycentric[1], m.barycentric[2]}}))
                    continue;
            }
            found.push_back({i, decision});
        }
        std::sort(found.begin(), found.end(), [&](const Found& x, const Found& y) {
            const int c = order(path, x.triangle, y.triangle);
            if (c != 0) return c < 0;
            if (faces_[x.triangle] != faces_[y.triangle]) return faces_[x.triangle] < faces_[y.triangle];
            return x.triangle < y.triangle;
        });
        return found;
    }

    struct OtherWays {
        const NaiveMesh& mesh;
        const detail::Path& path;
        const std::vector<Found>& found;
        std::size_t at;
        const QueryOptions& options;

        struct Nearby {
            explicit Nearby(const OtherWays&) {}
        };
        [[nodiscard]] bool hides(const detail::Point&) const { return false; }
        [[nodiscard]] bool clear(const detail::Point& point, bool) const { return !first(point); }
        bool stops(const detail::Point& point, detail::Corners& corners, detail::Decision& decision) const {
            const auto stop = first(point);
            if (!stop) return false;
            corners = mesh.corners_[stop->triangle];
            decision = stop->decision;
            return true;
        }
        // Of the hits on the way to the point, but for those strictly before the hit itself.
        [[nodiscard]] std::optional<Found> first(const detail::Point& point) const {
            for (const Found& other : mesh.hits({path.from, point}, options)) {
                const auto before = [&](const Found& f) {
                    return f.triangle == other.triangle && mesh.order(path, f.triangle, found[at].triangle) < 0;
                };
                if (std::none_of(found.begin(), found.end(), before)) return other;
            }
            return std::nullopt;
        }
    };

    [[nodiscard]] Hit<Scalar> reported(const detail::Path& path, const std::vector<Found>& found, std::size_t i,
                                       const QueryOptions& options) const {
        const std::uint32_t triangle = found[i].triangle;
        QueryCounters unused;
        detail::Measured measured;
        detail::measure_path<Scalar>(corners_[triangle], path, measured);
        detail::Values values;
        detail::Rounded<Scalar> rounded;
        Hit<Scalar> hit{};
        detail::certify(narrow(), measured, path, found[i].decision, grain_, unused, values, rounded);
        detail::report(rounded, found[i].decision, faces_[triangle], triangle, hit);
        QueryOptions whole = options;
        whole.max_fraction = 1;
        const OtherWays ways{*this, path, found, i, whole};
        detail::place(path, measured, found[i].decision, grain_, values, rounded, unused, ways, hit);
        return hit;
    }

    std::vector<detail::Corners> corners_;
    std::vector<std::uint32_t> faces_;
    double grain_ = 0;
};

}  // namespace pierce::test

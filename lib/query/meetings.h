// The faces of a scene that a path meets, and passages of them: taken together by place, in order, a few at a time.
#pragma once

#include <bit>

#include <exact/crossing.h>
#include <exact/touch.h>
#include <pierce/passage.h>
#include <query/broadphase.h>
#include <query/certified.h>
#include <query/meets.h>

namespace pierce::detail {

/// Whether a path meets a triangle that counts under `options`, unless it is beyond `limit`.
template <class Scalar>
[[nodiscard]] bool meets(const Scene<Scalar>& scene, const Path& path, TriangleRef triangle,
                         const QueryOptions& options, double limit, QueryCounters& counters, Meet& meet) {
    if (masked(scene, triangle, options)) return false;
    const Corners corners = scene.corners(triangle);
    Measured measured;
    measure_path<Scalar>(corners, path, measured);
    static_cast<Filtered&>(meet) = filter_strictly(measured, Sides::both);
    if (meet.verdict == Verdict::miss || meet.earliest > limit) return false;
    meet.triangle = triangle;
    meet.at_end = false;
    if (meet.verdict == Verdict::hit) {
        meet.crossing = meet.decision.side == Sides::front ? 1 : -1;
    } else {
        ++counters.exact_decisions;
        const PathTouch exact = touch(path, corners);
        if (!exact.decision.hit) return false;
        meet.decision = exact.decision;
        meet.at_end = exact.at_end;
        meet.crossing = crossing(path, corners);
        if (meet.at_end)
            meet.earliest = meet.latest = 1;
        else
            set_exact_interval(path, corners, counters, meet);
    }
    if (options.sides != Sides::both && options.sides != meet.decision.side) return false;
    const double most = options.max_fraction;
    if (meet.latest > most && (meet.earliest > most || !fraction_at_most(path, corners, most))) return false;
    return !options.accept || accepted(scene, path, triangle, meet.decision, measured, options, counters);
}

/// Calls `use(meet)` for all meets that count, up to `limit()`, which may decrease, of triangles that `wants` says yes
/// to.
template <class Scalar, class Wants, class Limit, class Use>
void each_meet(const Scene<Scalar>& scene, const Path& path, const QueryOptions& options, QueryCounters& counters,
               Wants&& wants, Limit&& limit, Use&& use) {
    const auto most = [&] { return std::min(limit(), options.max_fraction); };
    each_candidate(scene, path, options.sides, most(), counters, [&](ClusterRef cluster, unsigned lanes) {
        for (; lanes != 0; lanes &= lanes - 1) {
            const TriangleRef triangle{cluster, static_cast<std::uint32_t>(std::countr_zero(lanes))};
            Meet meet;
            if (wants(triangle) && meets(scene, path, triangle, options, most(), counters, meet)) use(meet);
        }
        return most();
    });
}

/// `first_face`: where the passage's faces begin among those of all.
template <class Scalar, class Found>
void write(const Scene<Scalar>& scene, const Path& path, const MeetingPlace<Found>& place, std::size_t first_face,
           QueryCounters& counters, Passage<Scalar>& out) {
    const std::size_t chosen = place.chosen();
    const Decision& decision = place.decisions[chosen];
    Measured measured;
    measure_path<Scalar>(scene.corners(place.triangles[chosen]), path, measured);
    Values values;
    Rounded<Scalar> rounded;
    certify(scene.narrow(), measured, path, decision, scene.grain, counters, values, rounded);
    out.at_start = decision.at_start;
    out.at_end = place.first.at_end;
    out.fraction = out.at_end ? Scalar(1) : rounded.weights[3];
    for (std::size_t k = 0; k < 3; ++k) {
        out.position[k] = out.at_end ? static_cast<Scalar>(path.to[k]) : rounded.position[k];
        out.normal[k] = rounded.normal[k];
    }
    out.face = place.faces[chosen].face;
    out.triangle = place.faces[chosen].triangle;
    out.first_face = first_face;
    out.face_count = place.face_count;
    out.crossings = place.crossings;
    out.kind = place.crossings > 0   ? PassageKind::entering
               : place.crossings < 0 ? PassageKind::leaving
                                     : PassageKind::grazing;
    out.side = decision.side;
    out.feature = decision.feature;
    out.feature_index = decision.feature_index;
}

/// Writes the faces of passages that were written, those of each only if all of them fit.
template <class Meetings>
void write_faces(const Meetings& meetings, const FirstPlaces<Meetings>& places,
                 std::span<const typename Meetings::Answer> passages, std::span<FaceTouch> faces) {
    const auto row_of = [](const typename Meetings::Answer& passage) -> const auto& {
        return Meetings::passage_of(passage);
    };
    const auto fits = [&](const auto& passage) {
        return row_of(passage).first_face + row_of(passage).face_count <= faces.size();
    };
    while (!passages.empty() && !fits(passages.back())) passages = passages.first(passages.size() - 1);
    if (passages.empty()) return;
    std::array<std::size_t, FirstPlaces<Meetings>::k_most> count{};
    const double last = places.kept()[passages.size() - 1].first.latest;
    meetings.each([last] { return last; },
                  [&](const typename Meetings::Found& meet) {
                      const auto [at, same] = places.find(meet);
                      if (!same || at >= passages.size() || count[at] == row_of(passages[at]).face_count) return;
                      faces[row_of(passages[at]).first_face + count[at]++] = meetings.touch(meet);
                  });
    for (const auto& passage : passages) {
        const auto row = faces.subspan(row_of(passage).first_face, row_of(passage).face_count);
        std::sort(row.begin(), row.end(), [](const FaceTouch& x, const FaceTouch& y) { return comes_before(x, y); });
    }
}

/// All that `CollisionMesh::passages` says. `Meetings` has, beside what FirstPlaces asks for,
///   Answer                            a Passage, or what holds one: `passage_of(answer)`
///   void each(limit, use)             calls `use(found)` for all meets up to `limit()`, which may decrease
///   void write(place, first_face, answer)
template <class Meetings>
[[nodiscard]] std::size_t all_passages(const Meetings& meetings, std::span<typename Meetings::Answer> out,
                                       std::span<FaceTouch> faces, bool count_all) {
    FirstPlaces<Meetings> places(meetings);
    std::size_t total = 0;
    std::size_t face_total = 0;
    for (;;) {
        const std::size_t first = std::min(total, out.size());
        if (!count_all && first == out.size()) return total;
        places.go_on(count_all ? places.k_most : out.size() - first);
        meetings.each([&] { return places.limit(); }, [&](const typename Meetings::Found& meet) { places.add(meet); });
        const auto kept = places.kept();
        const auto here = out.subspan(first, std::min(kept.size(), out.size() - first));
        for (std::size_t i = 0; i < here.size(); ++i) {
            meetings.write(kept[i], face_total, here[i]);
            face_total += kept[i].face_count;
        }
        write_faces<Meetings>(meetings, places, here, faces);
        total += kept.size();
        if (!places.full()) return total;
    }
}

}  // namespace pierce::detail

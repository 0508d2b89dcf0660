// Why each face near a segment is its first hit or is not.
#include <pierce/explain.h>

#include <algorithm>

#include <exact/volumes.h>
#include <query/collectors.h>
#include <query/engine.h>
#include <query/traverse.h>

namespace pierce {

std::string_view to_string(Reason reason) {
    switch (reason) {
        case Reason::first_hit: return "first hit";
        case Reason::later: return "later than the first hit";
        case Reason::apart: return "boxes apart";
        case Reason::zero_area: return "zero area";
        case Reason::masked: return "masked";
        case Reason::in_plane: return "segment in its plane";
        case Reason::in_front: return "stays in front";
        case Reason::behind: return "stays behind";
        case Reason::wrong_side: return "passes from the other side";
        case Reason::outside_edge: return "passes outside an edge";
        case Reason::too_far: return "beyond max_fraction";
        case Reason::not_accepted: return "not accepted";
    }
    return "";
}

namespace detail {

namespace {

// Why a triangle is not hit at all; `later` stands for one that is. The same signs as in decide(), in the same order.
FaceVerdict refusal(const Scene& scene, const Path& path, std::uint32_t triangle, const QueryOptions& options) {
    FaceVerdict verdict{scene.face_of(triangle), triangle, Reason::later};
    const Corners corners = scene.corners(triangle);
    if (has_zero_area(corners)) {
        verdict.reason = Reason::zero_area;
    } else if (!overlap(box_of(path), box_of(corners))) {
        verdict.reason = Reason::apart;
    } else if (masked(scene, triangle, options)) {
        verdict.reason = Reason::masked;
    } else {
        with_volumes(path, corners, [&](const auto& volumes) {
            const int from = volumes.from_side().sign();
            const int to = volumes.to_side().sign();
            const bool front = from >= 0 && to < 0;
            const bool back = from <= 0 && to > 0;
            if (from == 0 && to == 0) {
                verdict.reason = Reason::in_plane;
            } else if (!front && !back) {
                verdict.reason = from > 0 ? Reason::in_front : Reason::behind;
            } else if ((front && options.sides == Sides::back) || (back && options.sides == Sides::front)) {
                verdict.reason = Reason::wrong_side;
            } else {
                for (int edge = 2; edge >= 0; --edge)
                    if (volumes.weight((edge + 2) % 3).sign() == (front ? -1 : 1)) {
                        verdict.reason = Reason::outside_edge;
                        verdict.edge = static_cast<std::uint8_t>(edge);
                    }
            }
        });
    }
    return verdict;
}

}  // namespace

template <class Scalar>
std::vector<FaceVerdict> explain(const Scene& scene, const Segment<Scalar>& segment, const QueryOptions& options,
                                 QueryCounters& counters) {
    const Path path = to_path(segment);
    First first(scene, path, counters);
    traverse<Certified>(scene, path, options, counters, first);

    std::vector<std::uint32_t> near;
    visit_near(scene, path, [] { return 1.0; }, counters,
               [&](std::uint32_t triangle, const Visit&) { near.push_back(triangle); });
    // The grid does not list triangles without area.
    for (std::uint32_t i = 0; scene.degenerate > 0 && i < scene.triangles.size(); ++i)
        if (overlap(box_of(path), box_of(scene.corners(i))) && has_zero_area(scene.corners(i))) near.push_back(i);
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());

    std::vector<FaceVerdict> verdicts;
    verdicts.reserve(near.size());
    for (const std::uint32_t triangle : near) {
        FaceVerdict verdict = refusal(scene, path, triangle, options);
        if (verdict.reason == Reason::later) {
            const Corners corners = scene.corners(triangle);
            const Candidate candidate{triangle, decide(path, corners, options.sides)};
            if (!fraction_at_most(path, corners, options.max_fraction)) verdict.reason = Reason::too_far;
            else if (options.accept && !accepted(scene, path, candidate, options)) verdict.reason = Reason::not_accepted;
            else if (triangle == first.best().triangle) verdict.reason = Reason::first_hit;
        }
        verdicts.push_back(verdict);
    }
    return verdicts;
}

template std::vector<FaceVerdict> explain(const Scene&, const Segment<float>&, const QueryOptions&, QueryCounters&);
template std::vector<FaceVerdict> explain(const Scene&, const Segment<double>&, const QueryOptions&, QueryCounters&);

}  // namespace detail

}  // namespace pierce

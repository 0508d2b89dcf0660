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
template <class Scalar>
FaceVerdict refusal(const Scene<Scalar>& scene, const Path& path, std::uint32_t triangle, const QueryOptions& options) {
    FaceVerdict verdict{scene.face_of(triangle), scene.triangle_numbers[triangle], Reason::later};
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
            const bool front = passes_front(from, to);
            const bool back = passes_back(from, to, options.sides);
            if (from == 0 && to == 0) {
                verdict.reason = Reason::in_plane;
            } else if (!front && !back) {
                // 0 goes behind or in front, and both rules for one side call that a passage; `both` only the former.
                verdict.reason = from >= 0 ? Reason::in_front : Reason::behind;
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
std::vector<FaceVerdict> explain(const Scene<Scalar>& scene, const Segment<Scalar>& segment, const QueryOptions& options,
                                 QueryCounters& counters) {
    const Path path = to_path(segment);
    Search<Scalar> search(scene, path, options.sides);
    First<Scalar> first(scene, path, counters);
    traverse<Certified>(search, options, counters, first);

    std::vector<std::uint32_t> near;
    visit_all_near(search, counters, [&](const std::uint32_t* ids, unsigned count) { near.insert(near.end(), ids, ids + count); });
    // The grid does not list triangles without area.
    for (auto i = static_cast<std::uint32_t>(scene.triangles.size() - scene.degenerate); i < scene.triangles.size(); ++i)
        if (overlap(box_of(path), box_of(scene.corners(i)))) near.push_back(i);
    std::sort(near.begin(), near.end(),
              [&](std::uint32_t x, std::uint32_t y) { return scene.triangle_numbers[x] < scene.triangle_numbers[y]; });

    std::vector<FaceVerdict> verdicts;
    verdicts.reserve(near.size());
    for (const std::uint32_t triangle : near) {
        FaceVerdict verdict = refusal(scene, path, triangle, options);
        if (verdict.reason == Reason::later) {
            const Corners corners = scene.corners(triangle);
            const Candidate candidate{triangle, decide(path, corners, options.sides)};
            if (!fraction_at_most(path, corners, options.max_fraction)) verdict.reason = Reason::too_far;
            else if (options.accept && !accepted(scene, path, candidate, options, counters)) verdict.reason = Reason::not_accepted;
            else if (triangle == first.best().triangle) verdict.reason = Reason::first_hit;
        }
        verdicts.push_back(verdict);
    }
    return verdicts;
}

template std::vector<FaceVerdict> explain(const Scene<float>&, const Segment<float>&, const QueryOptions&, QueryCounters&);
template std::vector<FaceVerdict> explain(const Scene<double>&, const Segment<double>&, const QueryOptions&, QueryCounters&);

}  // namespace detail

}  // namespace pierce

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
        case Reason::first_hit:
            return "first hit";
        case Reason::later:
            return "later than the first hit";
        case Reason::apart:
            return "boxes apart";
        case Reason::zero_area:
            return "zero area";
        case Reason::masked:
            return "masked";
        case Reason::in_plane:
            return "segment in its plane";
        case Reason::in_front:
            return "stays in front";
        case Reason::behind:
            return "stays behind";
        case Reason::wrong_side:
            return "passes from the other side";
        case Reason::outside_edge:
            return "passes outside an edge";
        case Reason::too_far:
            return "beyond max_fraction";
        case Reason::not_accepted:
            return "not accepted";
    }
    return "";
}

namespace detail {

namespace {

// Why a triangle is not hit at all; `later` stands for one that is. The same signs as in decide(), in the same order.
FaceVerdict refusal(const Corners& corners, FaceVerdict verdict, const Path& path, const QueryOptions& options) {
    const auto masked = [&] {
        return !options.face_mask.empty() &&
               (verdict.face >= options.face_mask.size() || options.face_mask[verdict.face] == 0);
    };
    if (has_zero_area(corners)) {
        verdict.reason = Reason::zero_area;
    } else if (!overlap(box_of(path), box_of(corners))) {
        verdict.reason = Reason::apart;
    } else if (masked()) {
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

// The box and all that is no further from it, along each axis, than it is long along its longest.
Box surroundings(Box box) {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, box.high[k] - box.low[k]);
    for (std::size_t k = 0; k < 3; ++k) box.low[k] -= longest, box.high[k] += longest;
    return box;
}

}  // namespace

template <class Scalar>
std::vector<FaceVerdict> explain(const Scene<Scalar>& scene, const Segment<Scalar>& segment,
                                 const QueryOptions& options, QueryCounters& counters) {
    const Path path = to_path(segment);
    First<Scalar> first(scene, path, counters);
    traverse<Certified>(scene, path, options, counters, first);

    // All triangles are looked at: the broadphase does not tell what it left out. Those are named that are no further
    // away than the segment is long, whichever broadphase there is.
    const Box near = surroundings(box_of(path));
    std::vector<FaceVerdict> verdicts;
    const auto named = [&](std::uint32_t number) {
        return FaceVerdict{scene.face_of_number(number), number, Reason::later};
    };
    scene.each_triangle([&](TriangleRef triangle) {
        const Corners corners = scene.corners(triangle);
        if (!overlap(near, box_of(corners))) return;
        FaceVerdict verdict = refusal(corners, named(scene.number_of(triangle)), path, options);
        if (verdict.reason == Reason::later) {
            const Decision decision = decide(path, corners, options.sides);
            Measured measured;
            measure_path<Scalar>(corners, path, measured);
            if (!fraction_at_most(path, corners, options.max_fraction))
                verdict.reason = Reason::too_far;
            else if (options.accept && !accepted(scene, path, triangle, decision, measured, options, counters))
                verdict.reason = Reason::not_accepted;
            else if (first.found() && triangle == first.best().triangle)
                verdict.reason = Reason::first_hit;
        }
        verdicts.push_back(verdict);
    });
    for (const auto& [number, corners] : scene.degenerate)
        if (overlap(near, box_of(corners))) verdicts.push_back(refusal(corners, named(number), path, options));
    std::sort(verdicts.begin(), verdicts.end(),
              [](const FaceVerdict& x, const FaceVerdict& y) { return x.triangle < y.triangle; });
    return verdicts;
}

template std::vector<FaceVerdict> explain(const Scene<float>&, const Segment<float>&, const QueryOptions&,
                                          QueryCounters&);
template std::vector<FaceVerdict> explain(const Scene<double>&, const Segment<double>&, const QueryOptions&,
                                          QueryCounters&);

}  // namespace detail

}  // namespace pierce

// Passages through the meshes of a world, and why each face near a segment is hit first or is not.
#include <query/engine.h>
#include <query/meetings.h>
#include <world/engine.h>
#include <world/order.h>
#include <world/places.h>
#include <world/ways.h>

namespace pierce::detail {

namespace {

struct MeetInWorld : Meet {
    std::uint32_t index = 0;
};

/// The faces of all meshes (query/meetings.h). Those of two meshes are never at the same place: the lower index comes
/// first.
template <class Scalar>
struct WorldMeetings {
    using Found = MeetInWorld;
    using Answer = WorldPassage<Scalar>;

    const WorldScene<Scalar>& world;
    const Path& path;
    const WorldOptions& options;
    QueryCounters& counters;

    template <class Limit, class Use>
    void each(Limit&& limit, Use&& use) const {
        const auto most = [&] { return std::min(limit(), options.max_fraction); };
        each_image(world, path, options.mask, most(), counters,
                   [&](std::uint32_t index, const Instance<Scalar>& instance, const Path& local, double) {
                       QueryOptions here = options_in(options, world.id_of(index));
                       here.max_fraction = options.max_fraction;
                       const FaceFilter<Scalar> filter(instance, options.mask);
                       const auto wants = [&](TriangleRef triangle) { return filter.counts(triangle); };
                       each_meet(*instance.scene, local, here, counters, wants, limit, [&](const Meet& meet) {
                           use({meet, index});
                       });
                       return most();
                   });
    }
    [[nodiscard]] int order(const MeetInWorld& x, const MeetInWorld& y) const {
        if (x.index == y.index) {
            Path local;
            return set_local_path(world.instances[x.index], path, local)
                       ? order_along(*world.instances[x.index].scene, local, x, y, counters)
                       : 0;  // not where anything was met
        }
        const bool ends = (x.decision.at_start && y.decision.at_start) || (x.at_end && y.at_end);
        const int order = ends ? 0 : compare_exactly(world, path, {x.index, x}, {y.index, y}, counters);
        return order != 0 ? order : x.index < y.index ? -1 : 1;
    }
    [[nodiscard]] FaceTouch touch(const MeetInWorld& meet) const {
        return touch_of(*world.instances[meet.index].scene, meet.triangle, meet.decision, meet.crossing);
    }
    void write(const MeetingPlace<MeetInWorld>& place, std::size_t first_face, Answer& out) const {
        const Instance<Scalar>& instance = world.instances[place.first.index];
        Path local;
        if (!set_local_path(instance, path, local)) return;  // not where anything was met
        Passage<Scalar>& passage = out.passage;
        detail::write(*instance.scene, local, place, first_face, counters, passage);
        out.mesh = world.id_of(place.first.index);
        if (instance.still()) return;
        const Point at = passage.at_start ? path.from
                         : passage.at_end ? path.to
                                          : out_of(instance.placement, to_point(passage.position.vec()));
        passage.position = to_vector<Scalar>(at);
        if (instance.placement.stand == Stand::turned)
            passage.normal = to_vector<Scalar>(turned(instance.placement, to_point(passage.normal.vec())));
    }
    static const Passage<Scalar>& passage_of(const Answer& answer) { return answer.passage; }
};

}  // namespace

template <class Scalar>
std::size_t passages(const WorldScene<Scalar>& world, const Segment<Scalar>& segment,
                     std::span<WorldPassage<Scalar>> out, std::span<FaceTouch> faces, const WorldPassageOptions& given,
                     QueryCounters& counters) {
    const Path path = to_path(segment);
    const WorldOptions options{
        .sides = given.sides, .max_fraction = given.max_fraction, .mask = given.mask, .accept = given.accept};
    return all_passages(WorldMeetings<Scalar>{world, path, options, counters}, out, faces, given.count_all);
}

// What is first in a mesh comes later where another mesh is hit before.
template <class Scalar>
std::vector<WorldFaceVerdict> explain(const WorldScene<Scalar>& world, const Segment<Scalar>& segment,
                                      const WorldOptions& options, QueryCounters& counters) {
    const Path path = to_path(segment, options.max_fraction);
    const auto first = first_hit(world, segment, options, counters);
    std::vector<WorldFaceVerdict> verdicts;
    for (std::uint32_t index = 0; index < world.instances.size(); ++index) {
        const Instance<Scalar>& instance = world.instances[index];
        Path local;
        if (instance.owner == nullptr || (instance.layers & options.mask) == 0 ||
            !set_local_path(instance, path, local))
            continue;
        const MeshId mesh = world.id_of(index);
        QueryOptions here = options_in(options, mesh);
        here.max_fraction = options.max_fraction;
        std::vector<std::uint8_t> faces;
        if (instance.face_layers != nullptr) {
            for (const std::uint32_t layers : *instance.face_layers) faces.push_back((layers & options.mask) != 0);
            if (faces.empty()) faces.push_back(0);  // no face counts, which an empty mask does not say
            here.face_mask = faces;
        }
        const Segment<Scalar> image{to_vector<Scalar>(local.from), to_vector<Scalar>(local.to)};
        for (FaceVerdict verdict : explain(*instance.scene, image, here, counters)) {
            if (verdict.reason == Reason::first_hit && first->mesh != mesh) verdict.reason = Reason::later;
            verdicts.push_back({verdict, mesh});
        }
    }
    return verdicts;
}

#define PIERCE_PASSAGES(Scalar)                                                                                       \
    template std::size_t passages(const WorldScene<Scalar>&, const Segment<Scalar>&, std::span<WorldPassage<Scalar>>, \
                                  std::span<FaceTouch>, const WorldPassageOptions&, QueryCounters&);                  \
    template std::vector<WorldFaceVerdict> explain(const WorldScene<Scalar>&, const Segment<Scalar>&,                 \
                                                   const WorldOptions&, QueryCounters&)
PIERCE_PASSAGES(float);
PIERCE_PASSAGES(double);
#undef PIERCE_PASSAGES

}  // namespace pierce::detail

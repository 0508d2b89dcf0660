// Passages: all faces of a mesh that a path meets, taken together by place.
#include <query/passages.h>

#include <query/meetings.h>

namespace pierce::detail {

namespace {

/// The faces of one mesh (meetings.h).
template <class Scalar>
struct MeshMeetings {
    using Found = Meet;
    using Answer = Passage<Scalar>;

    const Scene<Scalar>& scene;
    const Path& path;
    const QueryOptions& options;
    QueryCounters& counters;

    template <class Limit, class Use>
    void each(Limit&& limit, Use&& use) const {
        const auto all = [](TriangleRef) { return true; };
        each_meet(scene, path, options, counters, all, limit, use);
    }
    [[nodiscard]] int order(const Meet& x, const Meet& y) const { return order_along(scene, path, x, y, counters); }
    [[nodiscard]] FaceTouch touch(const Meet& meet) const {
        return touch_of(scene, meet.triangle, meet.decision, meet.crossing);
    }
    void write(const MeetingPlace<Meet>& place, std::size_t first_face, Answer& out) const {
        detail::write(scene, path, place, first_face, counters, out);
    }
    static const Answer& passage_of(const Answer& passage) { return passage; }
};

}  // namespace

template <class Scalar>
std::size_t passages(const Scene<Scalar>& scene, const Segment<Scalar>& segment, std::span<Passage<Scalar>> out,
                     std::span<FaceTouch> faces, const PassageOptions& given, QueryCounters& counters) {
    const Path path = to_path(segment);
    const QueryOptions options{
        .sides = given.sides, .max_fraction = given.max_fraction, .face_mask = given.face_mask, .accept = given.accept};
    return all_passages(MeshMeetings<Scalar>{scene, path, options, counters}, out, faces, given.count_all);
}

template std::size_t passages(const Scene<float>&, const Segment<float>&, std::span<Passage<float>>,
                              std::span<FaceTouch>, const PassageOptions&, QueryCounters&);
template std::size_t passages(const Scene<double>&, const Segment<double>&, std::span<Passage<double>>,
                              std::span<FaceTouch>, const PassageOptions&, QueryCounters&);

}  // namespace pierce::detail

// That arrays of the C structures are arrays of the C++ ones, byte for byte, so that none is copied.
#pragma once

#include <cstddef>

#include <pierce/pierce.h>
#include <pierce/pierce_c.h>

#define SAME_SIZE(Outside, Inside) \
    static_assert(sizeof(Outside) == sizeof(Inside) && alignof(Outside) == alignof(Inside))
#define SAME_PLACE(Outside, Inside, member)                               \
    static_assert(offsetof(Outside, member) == offsetof(Inside, member)); \
    static_assert(sizeof(Outside::member) == sizeof(Inside::member))

namespace pierce::detail {

#define SAME_HIT(Outside, Inside)                \
    SAME_SIZE(Outside, Inside);                  \
    SAME_PLACE(Outside, Inside, fraction);       \
    SAME_PLACE(Outside, Inside, point);          \
    SAME_PLACE(Outside, Inside, position);       \
    SAME_PLACE(Outside, Inside, normal);         \
    SAME_PLACE(Outside, Inside, barycentric);    \
    SAME_PLACE(Outside, Inside, exact_fraction); \
    SAME_PLACE(Outside, Inside, face);           \
    SAME_PLACE(Outside, Inside, triangle);       \
    SAME_PLACE(Outside, Inside, side);           \
    SAME_PLACE(Outside, Inside, feature);        \
    SAME_PLACE(Outside, Inside, feature_index);  \
    SAME_PLACE(Outside, Inside, at_start);       \
    SAME_PLACE(Outside, Inside, reserved)
SAME_HIT(pierce_hit_f, Hit<float>);
SAME_HIT(pierce_hit_d, Hit<double>);

#define SAME_PASSAGE(Outside, Inside)           \
    SAME_SIZE(Outside, Inside);                 \
    SAME_PLACE(Outside, Inside, fraction);      \
    SAME_PLACE(Outside, Inside, position);      \
    SAME_PLACE(Outside, Inside, normal);        \
    SAME_PLACE(Outside, Inside, face);          \
    SAME_PLACE(Outside, Inside, triangle);      \
    SAME_PLACE(Outside, Inside, first_face);    \
    SAME_PLACE(Outside, Inside, face_count);    \
    SAME_PLACE(Outside, Inside, crossings);     \
    SAME_PLACE(Outside, Inside, kind);          \
    SAME_PLACE(Outside, Inside, side);          \
    SAME_PLACE(Outside, Inside, feature);       \
    SAME_PLACE(Outside, Inside, feature_index); \
    SAME_PLACE(Outside, Inside, at_start);      \
    SAME_PLACE(Outside, Inside, at_end)
SAME_PASSAGE(pierce_passage_f, Passage<float>);
SAME_PASSAGE(pierce_passage_d, Passage<double>);

#define SAME_LEG(Outside, Inside)          \
    SAME_SIZE(Outside, Inside);            \
    SAME_PLACE(Outside, Inside, entry);    \
    SAME_PLACE(Outside, Inside, exit);     \
    SAME_PLACE(Outside, Inside, region);   \
    SAME_PLACE(Outside, Inside, next);     \
    SAME_PLACE(Outside, Inside, face);     \
    SAME_PLACE(Outside, Inside, triangle); \
    SAME_PLACE(Outside, Inside, side);     \
    SAME_PLACE(Outside, Inside, consistent)
SAME_LEG(pierce_leg_f, Leg<float>);
SAME_LEG(pierce_leg_d, Leg<double>);

SAME_SIZE(pierce_face_touch, FaceTouch);
SAME_PLACE(pierce_face_touch, FaceTouch, face);
SAME_PLACE(pierce_face_touch, FaceTouch, triangle);
SAME_PLACE(pierce_face_touch, FaceTouch, feature);
SAME_PLACE(pierce_face_touch, FaceTouch, feature_index);
SAME_PLACE(pierce_face_touch, FaceTouch, crossing);

SAME_SIZE(pierce_location, Location);
SAME_PLACE(pierce_location, Location, place);
SAME_PLACE(pierce_location, Location, winding_number);
SAME_PLACE(pierce_location, Location, face_count);

SAME_SIZE(pierce_face_regions, FaceRegions);
SAME_PLACE(pierce_face_regions, FaceRegions, front);
SAME_PLACE(pierce_face_regions, FaceRegions, behind);

SAME_SIZE(pierce_counters, QueryCounters);
SAME_PLACE(pierce_counters, QueryCounters, queries);
SAME_PLACE(pierce_counters, QueryCounters, nodes);
SAME_PLACE(pierce_counters, QueryCounters, clusters);
SAME_PLACE(pierce_counters, QueryCounters, triangles);
SAME_PLACE(pierce_counters, QueryCounters, exact_decisions);
SAME_PLACE(pierce_counters, QueryCounters, exact_orders);
SAME_PLACE(pierce_counters, QueryCounters, exact_values);
SAME_PLACE(pierce_counters, QueryCounters, exact_sides);
SAME_PLACE(pierce_counters, QueryCounters, retreats);

// Numbers that mean the same.
template <class Outside, class Inside>
constexpr bool same(Outside outside, Inside inside) {
    return static_cast<int>(outside) == static_cast<int>(inside);
}
static_assert(same(PIERCE_OK, Status::ok) && same(PIERCE_BAD_MESH, Status::bad_mesh) &&
              same(PIERCE_BAD_FILE, Status::bad_file) && same(PIERCE_BAD_ARGUMENT, Status::bad_argument) &&
              same(PIERCE_OUT_OF_MEMORY, Status::out_of_memory) && same(PIERCE_FAILED, Status::failed));
static_assert(same(PIERCE_FRONT, Sides::front) && same(PIERCE_BACK, Sides::back) && same(PIERCE_BOTH, Sides::both));
static_assert(same(PIERCE_ON_FACE, Feature::face) && same(PIERCE_ON_EDGE, Feature::edge) &&
              same(PIERCE_ON_VERTEX, Feature::vertex));
static_assert(same(PIERCE_OUTSIDE, Place::outside) && same(PIERCE_INSIDE, Place::inside) &&
              same(PIERCE_ON_SURFACE, Place::on_surface));
static_assert(same(PIERCE_ENTERING, PassageKind::entering) && same(PIERCE_LEAVING, PassageKind::leaving) &&
              same(PIERCE_GRAZING, PassageKind::grazing));
static_assert(same(PIERCE_AUTOMATIC, Broadphase::automatic) && same(PIERCE_TREE, Broadphase::tree) &&
              same(PIERCE_GRID, Broadphase::grid));
static_assert(PIERCE_NO_FACE == no_face && PIERCE_NO_REGION == Regions<float>::no_region);

}  // namespace pierce::detail

// C interface: what queries answer, and what they may be told.
#pragma once

#include <pierce/pierce_c/basics.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The face and triangle of a hit that there is not.
#define PIERCE_NO_FACE 0xffffffffu

/// The side of a triangle that a segment comes from. A query takes any of the three, an answer has one of the first
/// two.
typedef enum pierce_sides {
    PIERCE_FRONT = 0,  ///< from in front of the plane or on it, to strictly behind
    PIERCE_BACK = 1,   ///< the same mirrored
    PIERCE_BOTH = 2,   ///< a change of side, where on the plane counts as in front
} pierce_sides;
/// What a place lies on, exactly.
typedef enum pierce_feature {
    PIERCE_ON_FACE = 0,    ///< the open face
    PIERCE_ON_EDGE = 1,    ///< an open edge: without its ends
    PIERCE_ON_VERTEX = 2,  ///< a corner
} pierce_feature;
/// Where a point is.
typedef enum pierce_place {
    PIERCE_OUTSIDE = 0,     ///< not on the surface, and the winding number is 0
    PIERCE_INSIDE = 1,      ///< not on the surface, and the winding number is not 0
    PIERCE_ON_SURFACE = 2,  ///< in a closed triangle
} pierce_place;
/// What a passage does to the winding number.
typedef enum pierce_passage_kind {
    PIERCE_ENTERING = 0,  ///< raises it
    PIERCE_LEAVING = 1,   ///< lowers it
    PIERCE_GRAZING = 2,   ///< leaves it as it was
} pierce_passage_kind;

/// A hit: `Hit` of hit.h, byte for byte (72 of them). With no hit `face` and `triangle` are PIERCE_NO_FACE, all else is
/// 0.
typedef struct PIERCE_MAY_ALIAS pierce_hit_f {
    float fraction;         ///< of the segment, in [0, 1], or the ray's t: a lower bound that belongs to `point`
    float point[3];         ///< where to stop: the way to it is clear, and it is on the near side of the face
    float position[3];      ///< the true point, each coordinate rounded correctly; may lie behind the face
    float normal[3];        ///< of unit length, to the front of the face whichever side was hit
    float barycentric[3];   ///< weights of the triangle's corners in the true point, in [0, 1]
    float exact_fraction;   ///< the true fraction or t, within 1 ulp
    uint32_t face;          ///< the caller's number
    uint32_t triangle;      ///< its place among the triangles of the mesh
    uint8_t side;           ///< pierce_sides: front or back
    uint8_t feature;        ///< pierce_feature
    uint8_t feature_index;  ///< edge k goes from corner k to corner k + 1 (mod 3); corner k; else 0
    bool at_start;          ///< the exact fraction is 0
    uint32_t reserved;      ///< 0
} pierce_hit_f;

/// The same in double (128 bytes).
typedef struct PIERCE_MAY_ALIAS pierce_hit_d {
    double fraction;
    double point[3];
    double position[3];
    double normal[3];
    double barycentric[3];
    double exact_fraction;
    uint32_t face;
    uint32_t triangle;
    uint8_t side;
    uint8_t feature;
    uint8_t feature_index;
    bool at_start;
    uint32_t reserved;
} pierce_hit_d;

/// A triangle that a point or a segment meets in one point.
typedef struct PIERCE_MAY_ALIAS pierce_face_touch {
    uint32_t face;          ///< the caller's number
    uint32_t triangle;      ///< its place among the triangles of the mesh
    uint8_t feature;        ///< pierce_feature
    uint8_t feature_index;  ///< as in `pierce_hit_f`
    int8_t crossing;        ///< what it adds to `crossings` of its passage: 1, 0 or -1. 0 for a point.
} pierce_face_touch;

/// Where a point is (location.h).
typedef struct PIERCE_MAY_ALIAS pierce_location {
    uint8_t place;       ///< pierce_place
    int winding_number;  ///< as `pierce_winding_number_f` gives it
    size_t face_count;   ///< how many triangles the point lies on
} pierce_location;

/// One place where a segment passes through the surface or touches it, the faces that meet there taken together
/// (passage.h).
typedef struct PIERCE_MAY_ALIAS pierce_passage_f {
    float fraction;         ///< in [0, 1], within 1 ulp
    float position[3];      ///< the true point, rounded correctly
    float normal[3];        ///< of `face`, to its front
    uint32_t face;          ///< the one that stands for all of them
    uint32_t triangle;      ///< of `face`
    size_t first_face;      ///< the place of its first face among those of all passages
    size_t face_count;      ///< how many triangles meet the segment here
    int crossings;          ///< how often it passes from front to back here, less how often the other way
    uint8_t kind;           ///< pierce_passage_kind
    uint8_t side;           ///< pierce_sides
    uint8_t feature;        ///< pierce_feature
    uint8_t feature_index;  ///< as in `pierce_hit_f`
    bool at_start;          ///< the exact fraction is 0
    bool at_end;            ///< the exact fraction is 1
} pierce_passage_f;

typedef struct PIERCE_MAY_ALIAS pierce_passage_d {
    double fraction;
    double position[3];
    double normal[3];
    uint32_t face;
    uint32_t triangle;
    size_t first_face;
    size_t face_count;
    int crossings;
    uint8_t kind;
    uint8_t side;
    uint8_t feature;
    uint8_t feature_index;
    bool at_start;
    bool at_end;
} pierce_passage_d;

/// What queries went through, added up over those that were given the same counters. Set it to zero first.
typedef struct PIERCE_MAY_ALIAS pierce_counters {
    uint64_t queries;          ///< single ones, or those of batches
    uint64_t nodes;            ///< of the tree, or cells of the grid
    uint64_t clusters;         ///< of up to eight triangles
    uint64_t triangles;        ///< that the wide kernels could not refuse
    uint64_t exact_decisions;  ///< triangles that the filter left doubtful
    uint64_t exact_orders;     ///< pairs of hits too close to be ordered without exact arithmetic
    uint64_t exact_values;     ///< times that values of a hit took exact arithmetic
    uint64_t exact_sides;      ///< points so close to a plane that their side took exact arithmetic
    uint64_t retreats;         ///< places for verified points that were not clear
} pierce_counters;

/// A hit before it is weighed against others.
typedef struct pierce_contact {
    uint32_t face;          ///< the caller's number
    uint32_t triangle;      ///< its place among the triangles of the mesh
    uint8_t side;           ///< pierce_sides: front or back
    uint8_t feature;        ///< pierce_feature
    uint8_t feature_index;  ///< as in `pierce_hit_f`
    bool at_start;          ///< the exact fraction is 0
    double fraction;        ///< within 1 ulp, not verified
    double barycentric[3];  ///< weights of the corners, in [0, 1]
} pierce_contact;

/// Whether a hit counts. May be asked about the same face more than once, and in a batch with an executor from that
/// one's threads: the answer must depend on the contact only.
typedef bool (*pierce_accept)(const pierce_contact* contact, void* user);

/// Zeros are the defaults. A hit that is left out hides nothing behind it.
typedef struct pierce_query_options {
    pierce_sides sides;          ///< that segments must come from; the front by default
    const double* max_fraction;  ///< the greatest exact fraction, or t of a ray, that counts; NULL: infinity
    const uint8_t* face_mask;    ///< only faces count whose number is a place in it that is not 0
    size_t face_mask_count;      ///< 0: no mask, all faces count
    pierce_accept accept;        ///< if given, only hits count that it says yes to
    void* accept_user;           ///< handed to `accept`
    pierce_counters* counters;   ///< adds up what was gone through, if given
} pierce_query_options;

/// Zeros are the defaults: all faces count, from both sides.
typedef struct pierce_passage_options {
    bool one_sided;              ///< only faces that the segment's direction leads through from `side`
    pierce_sides side;           ///< used with `one_sided`
    const double* max_fraction;  ///< NULL: 1
    const uint8_t* face_mask;    ///< as in `pierce_query_options`
    size_t face_mask_count;      ///< 0: no mask
    pierce_accept accept;        ///< as in `pierce_query_options`
    void* accept_user;           ///< handed to `accept`
    pierce_counters* counters;   ///< adds up what was gone through, if given
    bool stop_when_full;         ///< what comes after the passages that fit is not looked for, nor counted
} pierce_passage_options;

#ifdef __cplusplus
}
#endif

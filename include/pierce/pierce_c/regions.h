// C interface: which regions a flight goes through (regions.h has the rule, and a transport loop).
#pragma once

#include <pierce/pierce_c/mesh.h>
#include <pierce/pierce_c/values.h>

#ifdef __cplusplus
extern "C" {
#endif

/// No region: what null regions say.
#define PIERCE_NO_REGION 0xffffffffu

/// The regions of a mesh with labels, whose faces must not pass through each other (regions.h). Refers to the mesh,
/// which must be destroyed later.
typedef struct pierce_regions_f pierce_regions_f;
typedef struct pierce_regions_d pierce_regions_d;

/// The regions on the two sides of a face: numbers of the caller's choice.
typedef struct PIERCE_MAY_ALIAS pierce_face_regions {
    uint32_t front;   ///< on the side that sees its corners counter-clockwise
    uint32_t behind;  ///< on the other side
} pierce_face_regions;

/// `labels[f]` is for the caller's face f; copied. `outside`: the region around the model. On failure `*regions` is
/// NULL: PIERCE_BAD_ARGUMENT where a face has no label.
PIERCE_EXPORT pierce_status pierce_regions_create_f(const pierce_mesh_f* mesh, const pierce_face_regions* labels,
                                                    size_t label_count, uint32_t outside, pierce_regions_f** regions);
PIERCE_EXPORT pierce_status pierce_regions_create_d(const pierce_mesh_d* mesh, const pierce_face_regions* labels,
                                                    size_t label_count, uint32_t outside, pierce_regions_d** regions);
/// Frees the regions; NULL is fine.
PIERCE_EXPORT void pierce_regions_destroy_f(pierce_regions_f* regions);
PIERCE_EXPORT void pierce_regions_destroy_d(pierce_regions_d* regions);

/// The region around the model, as it was given.
PIERCE_EXPORT uint32_t pierce_regions_outside_f(const pierce_regions_f* regions);
PIERCE_EXPORT uint32_t pierce_regions_outside_d(const pierce_regions_d* regions);

/// The region of a point.
PIERCE_EXPORT uint32_t pierce_region_at_f(const pierce_regions_f* regions, const float* point);
PIERCE_EXPORT uint32_t pierce_region_at_d(const pierce_regions_d* regions, const double* point);

/// A part of a flight that lies in one region.
typedef struct PIERCE_MAY_ALIAS pierce_leg_f {
    float entry;        ///< fraction of the segment, or t of the ray
    float exit;         ///< the same, at its end
    uint32_t region;    ///< that all of it lies in
    uint32_t next;      ///< the region behind the face at `exit`; `region` where the flight ends
    uint32_t face;      ///< the caller's number of the face at `exit`; PIERCE_NO_FACE where the flight ends
    uint32_t triangle;  ///< of that face; PIERCE_NO_FACE where the flight ends
    uint8_t side;       ///< pierce_sides: that the flight comes to the face from
    bool consistent;    ///< the face at `exit` has `region` on this side: if not, the labels are wrong
} pierce_leg_f;

typedef struct PIERCE_MAY_ALIAS pierce_leg_d {
    double entry;
    double exit;
    uint32_t region;
    uint32_t next;
    uint32_t face;
    uint32_t triangle;
    uint8_t side;
    bool consistent;
} pierce_leg_d;

/// Writes the first `capacity` legs of a flight, in order, and returns how many that are. If the last one's face is not
/// PIERCE_NO_FACE there may be more.
PIERCE_EXPORT size_t pierce_walk_f(const pierce_regions_f* regions, const float* from, const float* to,
                                   pierce_leg_f* legs, size_t capacity);
PIERCE_EXPORT size_t pierce_walk_d(const pierce_regions_d* regions, const double* from, const double* to,
                                   pierce_leg_d* legs, size_t capacity);
PIERCE_EXPORT size_t pierce_walk_of_ray_f(const pierce_regions_f* regions, const float* origin, const float* direction,
                                          float limit, pierce_leg_f* legs, size_t capacity);
PIERCE_EXPORT size_t pierce_walk_of_ray_d(const pierce_regions_d* regions, const double* origin,
                                          const double* direction, double limit, pierce_leg_d* legs, size_t capacity);

/// A place for a particle, and the region that it lies in.
typedef struct pierce_region_place_f {
    float point[3];   ///< representable, as it is
    uint32_t region;  ///< the region of `point`
    bool reached;     ///< whether that is the region asked for, with nothing else on the way
} pierce_region_place_f;

typedef struct pierce_region_place_d {
    double point[3];
    uint32_t region;
    bool reached;
} pierce_region_place_d;

/// Where a particle stops that goes to the end of a flight's **first** leg: before the face, in the leg's region, or at
/// the end of the flight. Returns `reached`. False, and nothing is written, where a pointer is null.
PIERCE_EXPORT bool pierce_stop_f(const pierce_regions_f* regions, const float* from, const float* to,
                                 const pierce_leg_f* first, pierce_region_place_f* place);
PIERCE_EXPORT bool pierce_stop_d(const pierce_regions_d* regions, const double* from, const double* to,
                                 const pierce_leg_d* first, pierce_region_place_d* place);
PIERCE_EXPORT bool pierce_stop_of_ray_f(const pierce_regions_f* regions, const float* origin, const float* direction,
                                        float limit, const pierce_leg_f* first, pierce_region_place_f* place);
PIERCE_EXPORT bool pierce_stop_of_ray_d(const pierce_regions_d* regions, const double* origin, const double* direction,
                                        double limit, const pierce_leg_d* first, pierce_region_place_d* place);

/// Where a particle goes on from that passes the face at the end of a flight's **first** leg: beyond it, in the region
/// `next`. Returns as `pierce_stop`.
PIERCE_EXPORT bool pierce_cross_f(const pierce_regions_f* regions, const float* from, const float* to,
                                  const pierce_leg_f* first, pierce_region_place_f* place);
PIERCE_EXPORT bool pierce_cross_d(const pierce_regions_d* regions, const double* from, const double* to,
                                  const pierce_leg_d* first, pierce_region_place_d* place);
PIERCE_EXPORT bool pierce_cross_of_ray_f(const pierce_regions_f* regions, const float* origin, const float* direction,
                                         float limit, const pierce_leg_f* first, pierce_region_place_f* place);
PIERCE_EXPORT bool pierce_cross_of_ray_d(const pierce_regions_d* regions, const double* origin, const double* direction,
                                         double limit, const pierce_leg_d* first, pierce_region_place_d* place);

/// Where labels disagree (label_report.h).
typedef struct pierce_label_report {
    bool agree;       ///< every point of space has one region, whatever face it is seen from
    size_t edges;     ///< at which faces disagree
    size_t floating;  ///< parts that share no edge with others and lie in another region than they say
} pierce_label_report;

/// Whether the labels agree wherever two faces bound one region. `report` may be NULL, and the text goes as that of
/// `pierce_mesh_report`.
PIERCE_EXPORT pierce_status pierce_regions_check_f(const pierce_regions_f* regions, pierce_label_report* report,
                                                   char* text, size_t text_size, size_t* text_length);
PIERCE_EXPORT pierce_status pierce_regions_check_d(const pierce_regions_d* regions, pierce_label_report* report,
                                                   char* text, size_t text_size, size_t* text_length);

#ifdef __cplusplus
}
#endif

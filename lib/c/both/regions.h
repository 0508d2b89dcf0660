// Regions in C, for one scalar. Included twice by pierce_c.cpp.

struct C(regions) {
    Regions<SCALAR> regions;
};

pierce_status C(regions_create)(const C(mesh)* mesh, const pierce_face_regions* labels, size_t label_count,
                                uint32_t outside, C(regions)** regions) {
    if (regions != nullptr) *regions = nullptr;
    return guarded(__func__, [&](const Caller& caller) {
        C(regions)*& out = caller.given(regions, "regions");
        const auto all = caller.array(same_bytes<const FaceRegions>(labels), label_count, "labels");
        out = new C(regions){Regions<SCALAR>(caller.given(mesh, "mesh").mesh, all, outside)};
    });
}

void C(regions_destroy)(C(regions)* regions) { delete regions; }

uint32_t C(regions_outside)(const C(regions)* regions) {
    return regions == nullptr ? PIERCE_NO_REGION : regions->regions.outside();
}

uint32_t C(region_at)(const C(regions)* regions, const SCALAR* point) {
    if (regions == nullptr || point == nullptr) return PIERCE_NO_REGION;
    return regions->regions.region_at(vector_of(point));
}

size_t C(walk)(const C(regions)* regions, const SCALAR* from, const SCALAR* to, C(leg)* legs, size_t capacity) {
    if (regions == nullptr || from == nullptr || to == nullptr) return 0;
    return regions->regions.walk(Segment<SCALAR>{vector_of(from), vector_of(to)}, room<Leg<SCALAR>>(legs, capacity));
}

size_t C(walk_of_ray)(const C(regions)* regions, const SCALAR* origin, const SCALAR* direction, SCALAR limit,
                      C(leg)* legs, size_t capacity) {
    if (regions == nullptr || origin == nullptr || direction == nullptr) return 0;
    const Ray<SCALAR> flight{vector_of(origin), vector_of(direction), limit};
    return regions->regions.walk(flight, room<Leg<SCALAR>>(legs, capacity));
}

bool C(stop)(const C(regions)* regions, const SCALAR* from, const SCALAR* to, const C(leg)* first,
             C(region_place)* place) {
    if (regions == nullptr || from == nullptr || to == nullptr || first == nullptr || place == nullptr) return false;
    const Segment<SCALAR> flight{vector_of(from), vector_of(to)};
    return give(regions->regions.stop(flight, *same_bytes<const Leg<SCALAR>>(first)), *place);
}

bool C(stop_of_ray)(const C(regions)* regions, const SCALAR* origin, const SCALAR* direction, SCALAR limit,
                    const C(leg)* first, C(region_place)* place) {
    if (regions == nullptr || origin == nullptr || direction == nullptr || first == nullptr || place == nullptr)
        return false;
    const Ray<SCALAR> flight{vector_of(origin), vector_of(direction), limit};
    return give(regions->regions.stop(flight, *same_bytes<const Leg<SCALAR>>(first)), *place);
}

bool C(cross)(const C(regions)* regions, const SCALAR* from, const SCALAR* to, const C(leg)* first,
              C(region_place)* place) {
    if (regions == nullptr || from == nullptr || to == nullptr || first == nullptr || place == nullptr) return false;
    const Segment<SCALAR> flight{vector_of(from), vector_of(to)};
    return give(regions->regions.cross(flight, *same_bytes<const Leg<SCALAR>>(first)), *place);
}

bool C(cross_of_ray)(const C(regions)* regions, const SCALAR* origin, const SCALAR* direction, SCALAR limit,
                     const C(leg)* first, C(region_place)* place) {
    if (regions == nullptr || origin == nullptr || direction == nullptr || first == nullptr || place == nullptr)
        return false;
    const Ray<SCALAR> flight{vector_of(origin), vector_of(direction), limit};
    return give(regions->regions.cross(flight, *same_bytes<const Leg<SCALAR>>(first)), *place);
}

pierce_status C(regions_check)(const C(regions)* regions, pierce_label_report* report, char* text, size_t text_size,
                               size_t* text_length) {
    return guarded(__func__, [&](const Caller& caller) {
        const LabelReport all = caller.given(regions, "regions").regions.check();
        const std::string lines = all.to_string();
        give(lines, text, text_size, text_length);
        if (report != nullptr) *report = {all.agree(), all.edges, all.floating};
    });
}

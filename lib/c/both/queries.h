// Single queries in C, for one scalar. Included twice by pierce_c.cpp.

bool C(first_hit)(const C(mesh)* mesh, const SCALAR* from, const SCALAR* to, C(hit)* hit,
                  const pierce_query_options* options) {
    QueryOptions how;
    if (mesh == nullptr || from == nullptr || to == nullptr || !read_options(options, how))
        return give_no_hit<SCALAR>(hit);
    return give(mesh->mesh.first_hit({vector_of(from), vector_of(to)}, how), hit);
}

bool C(sweep)(const C(mesh)* mesh, const SCALAR* from, const SCALAR* to, C(hit)* hit,
              const pierce_query_options* options) {
    return C(first_hit)(mesh, from, to, hit, options);
}

bool C(any_hit)(const C(mesh)* mesh, const SCALAR* from, const SCALAR* to, const pierce_query_options* options) {
    QueryOptions how;
    if (mesh == nullptr || from == nullptr || to == nullptr || !read_options(options, how)) return false;
    return mesh->mesh.any_hit({vector_of(from), vector_of(to)}, how);
}

size_t C(all_hits)(const C(mesh)* mesh, const SCALAR* from, const SCALAR* to, C(hit)* hits, size_t capacity,
                   const pierce_query_options* options) {
    QueryOptions how;
    if (mesh == nullptr || from == nullptr || to == nullptr || !read_options(options, how)) return 0;
    return mesh->mesh.all_hits({vector_of(from), vector_of(to)}, room<Hit<SCALAR>>(hits, capacity), how);
}

int C(crossings)(const C(mesh)* mesh, const SCALAR* from, const SCALAR* to, pierce_counters* counters) {
    if (mesh == nullptr || from == nullptr || to == nullptr) return 0;
    return mesh->mesh.crossings({vector_of(from), vector_of(to)}, counters_of(counters));
}

bool C(first_hit_of_ray)(const C(mesh)* mesh, const SCALAR* origin, const SCALAR* direction, SCALAR limit, C(hit)* hit,
                         const pierce_query_options* options) {
    QueryOptions how;
    if (mesh == nullptr || origin == nullptr || direction == nullptr || !read_options(options, how))
        return give_no_hit<SCALAR>(hit);
    return give(mesh->mesh.first_hit(Ray<SCALAR>{vector_of(origin), vector_of(direction), limit}, how), hit);
}

bool C(any_hit_of_ray)(const C(mesh)* mesh, const SCALAR* origin, const SCALAR* direction, SCALAR limit,
                       const pierce_query_options* options) {
    QueryOptions how;
    if (mesh == nullptr || origin == nullptr || direction == nullptr || !read_options(options, how)) return false;
    return mesh->mesh.any_hit(Ray<SCALAR>{vector_of(origin), vector_of(direction), limit}, how);
}

size_t C(all_hits_of_ray)(const C(mesh)* mesh, const SCALAR* origin, const SCALAR* direction, SCALAR limit,
                          C(hit)* hits, size_t capacity, const pierce_query_options* options) {
    QueryOptions how;
    if (mesh == nullptr || origin == nullptr || direction == nullptr || !read_options(options, how)) return 0;
    const Ray<SCALAR> ray{vector_of(origin), vector_of(direction), limit};
    return mesh->mesh.all_hits(ray, room<Hit<SCALAR>>(hits, capacity), how);
}

int C(crossings_of_ray)(const C(mesh)* mesh, const SCALAR* origin, const SCALAR* direction, SCALAR limit,
                        pierce_counters* counters) {
    if (mesh == nullptr || origin == nullptr || direction == nullptr) return 0;
    return mesh->mesh.crossings(Ray<SCALAR>{vector_of(origin), vector_of(direction), limit}, counters_of(counters));
}

int C(winding_number)(const C(mesh)* mesh, const SCALAR* point, pierce_counters* counters) {
    if (mesh == nullptr || point == nullptr) return 0;
    return mesh->mesh.winding_number(vector_of(point), counters_of(counters));
}

bool C(contains)(const C(mesh)* mesh, const SCALAR* point, pierce_counters* counters) {
    if (mesh == nullptr || point == nullptr) return false;
    return mesh->mesh.contains(vector_of(point), counters_of(counters));
}

pierce_location C(locate)(const C(mesh)* mesh, const SCALAR* point, pierce_face_touch* faces, size_t capacity,
                          pierce_counters* counters) {
    Location where;
    if (mesh != nullptr && point != nullptr)
        where = mesh->mesh.locate(vector_of(point), room<FaceTouch>(faces, capacity), counters_of(counters));
    return {static_cast<uint8_t>(where.place), where.winding_number, where.face_count};
}

size_t C(passages)(const C(mesh)* mesh, const SCALAR* from, const SCALAR* to, C(passage)* passages, size_t capacity,
                   pierce_face_touch* faces, size_t face_capacity, const pierce_passage_options* options) {
    PassageOptions how;
    if (mesh == nullptr || from == nullptr || to == nullptr || !read_options(options, how)) return 0;
    return mesh->mesh.passages({vector_of(from), vector_of(to)}, room<Passage<SCALAR>>(passages, capacity), how,
                               room<FaceTouch>(faces, face_capacity));
}

// Meshes and files in C, for one scalar. Included twice by pierce_c.cpp.

struct C(mesh) {
    CollisionMesh<SCALAR> mesh;
};
struct C(soup) {
    TriangleSoup<SCALAR> soup;
};

pierce_status C(mesh_create)(const C(points)* positions, const pierce_triangles* triangles,
                             const pierce_build_options* options, C(mesh)** mesh) {
    if (mesh != nullptr) *mesh = nullptr;
    return guarded(__func__, [&](const Caller& caller) {
        C(mesh)*& out = caller.given(mesh, "mesh");
        const C(points)& all = caller.given(positions, "positions");
        const pierce_triangles& corners = caller.given(triangles, "triangles");
        MeshView<SCALAR> view{points_of(caller, all, "positions.first"), triangles_of(caller, corners)};
        if (corners.faces != nullptr) view.faces = {corners.faces, corners.count};
        out = new C(mesh){CollisionMesh<SCALAR>(view, options_of(caller, options))};
    });
}

void C(mesh_destroy)(C(mesh)* mesh) { delete mesh; }

void C(mesh_statistics)(const C(mesh)* mesh, pierce_statistics* statistics) {
    if (statistics == nullptr) return;
    *statistics = {};
    if (mesh == nullptr) return;
    const MeshStatistics all = mesh->mesh.statistics();
    statistics->vertices = all.vertices;
    statistics->faces = all.faces;
    statistics->triangles = all.triangles;
    statistics->degenerate = all.degenerate;
    statistics->clusters = all.clusters;
    statistics->broadphase = static_cast<pierce_broadphase>(all.broadphase);
    statistics->nodes = all.nodes;
    statistics->cell_size = all.cell_size;
    statistics->grid_references = all.grid_references;
    all.backend.copy(statistics->backend, sizeof statistics->backend - 1);
    statistics->bytes = all.bytes;
    statistics->invalid_queries = all.invalid_queries;
}

pierce_status C(mesh_report)(const C(mesh)* mesh, pierce_mesh_report* report, char* text, size_t text_size,
                             size_t* text_length) {
    return guarded(__func__, [&](const Caller& caller) {
        const MeshReport all = caller.given(mesh, "mesh").mesh.mesh_report();
        const std::string lines = all.to_string();
        give(lines, text, text_size, text_length);
        if (report == nullptr) return;
        *report = {};
        report->closed = all.closed();
        report->zero_area = all.zero_area;
        report->duplicates = all.duplicates;
        report->border_edges = all.border_edges;
        report->non_manifold_edges = all.non_manifold_edges;
        report->misoriented_edges = all.misoriented_edges;
        report->non_manifold_vertices = all.non_manifold_vertices;
        report->t_junctions = all.t_junctions;
        report->components = all.components;
        static_assert(sizeof report->edges_with == sizeof all.edges_with);
        std::copy(all.edges_with.begin(), all.edges_with.end(), report->edges_with);
    });
}

pierce_status C(soup_read)(const char* path, const pierce_read_options* options, C(soup)** soup) {
    if (soup != nullptr) *soup = nullptr;
    return guarded(
        __func__,
        [&](const Caller& caller) {
            C(soup)*& out = caller.given(soup, "soup");
            ReadOptions keep;
            if (options != nullptr) keep = {.materials = options->materials, .groups = options->groups};
            out = new C(soup){read_mesh<SCALAR>(&caller.given(path, "path"), keep)};
        },
        Status::bad_file);
}

void C(soup_destroy)(C(soup)* soup) { delete soup; }

void C(soup_view)(const C(soup)* soup, C(points)* positions, pierce_triangles* triangles) {
    if (positions != nullptr) *positions = {};
    if (triangles != nullptr) *triangles = {};
    if (soup == nullptr) return;
    const MeshView<SCALAR> view = soup->soup.view();
    if (positions != nullptr) {
        positions->first = view.positions.data();
        positions->count = view.positions.size();
    }
    if (triangles != nullptr) {
        triangles->first = view.triangles.data();
        triangles->count = view.triangles.size();
        triangles->faces = view.faces.empty() ? nullptr : view.faces.data();
    }
}

const char* C(soup_material)(const C(soup)* soup, uint32_t face) {
    return soup == nullptr ? nullptr : name_of(soup->soup.materials, soup->soup.material_of_face, face);
}

const char* C(soup_group)(const C(soup)* soup, uint32_t face) {
    return soup == nullptr ? nullptr : name_of(soup->soup.groups, soup->soup.group_of_face, face);
}

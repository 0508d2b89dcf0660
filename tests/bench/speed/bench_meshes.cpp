#include "bench_meshes.h"

#include <filesystem>

#include <support/meshes.h>

namespace pierce::bench {

TriangleSoup<float> BenchMesh::load() const {
    if (!path.empty()) return read_mesh<float>(path);
    return test::moved<float>(test::bumpy_sphere(divisions), 1, {0, 0, 0});
}

std::vector<BenchMesh> bench_meshes(bool large) {
    const std::string cgal = PIERCE_CGAL_MESHES "/";
    const std::string shared = PIERCE_SHARED_MESHES "/";
    std::vector<BenchMesh> meshes;
    const auto add = [&](const char* name, MeshKind kind, const std::string& path) {
        if (std::filesystem::exists(path)) meshes.push_back({.name = name, .kind = kind, .path = path});
    };
    // Characters and scans, and CAD parts (fandisk, turbine). Their bunny stands in where the Stanford one is missing.
    add("turbine", MeshKind::real, cgal + "turbine.off");
    add("mannequin", MeshKind::real, cgal + "mannequin-devil.off");
    add("fandisk", MeshKind::real, cgal + "fandisk_large.off");
    add("diplodocus", MeshKind::real, cgal + "diplodocus.off");
    add("armadillo", MeshKind::real, cgal + "armadillo.off");
    add("elephant", MeshKind::real, cgal + "refined_elephant.off");
    add("dungeon", MeshKind::real, shared + "dungeon.obj");
    add("bunny", MeshKind::real, shared + "stanford-bunny.obj");
    if (meshes.empty() || meshes.back().name != "bunny") add("bunny", MeshKind::real, cgal + "bunny00.off");
    add("dragon", MeshKind::real, shared + "dragon.ply");
    add("kitchen", MeshKind::real, shared + "kitchen_merged.ply");
    add("terrain", MeshKind::real, shared + "jacksboro_dem.ply");
    add("stadium", MeshKind::stadium, shared + "teapot_in_stadium.ply");
    const auto add_sphere = [&](const char* name, int divisions) {
        meshes.push_back({.name = name, .kind = MeshKind::sphere, .path = {}, .divisions = divisions});
    };
    add_sphere("sphere10k", 35);
    add_sphere("sphere100k", 112);
    add_sphere("sphere1M", 354);
    if (large) add_sphere("sphere10M", 1118);
    return meshes;
}

}  // namespace pierce::bench

// See report.h.
#include "cast/report.h"

#include <cmath>
#include <string>

#include "cast/numbers.h"

namespace {

/// "1 face", "2 faces"
std::string counted(std::uint64_t count, const std::string& one, const std::string& many = "") {
    return grouped(count) + " " + (count == 1 ? one : many.empty() ? one + "s" : many);
}

std::string per(double amount, std::size_t count) {
    if (count == 0) return "-";
    const double each = amount / static_cast<double>(count);
    return each < 100 ? rounded(each, 3) : grouped(static_cast<std::uint64_t>(std::llround(each)));
}

/// Why a particle could get through.
std::string openness(const pierce::MeshReport& odd) {
    if (odd.components == 0) return "empty";
    if (odd.closed()) return "closed";
    std::string why;
    if (odd.border_edges > 0) why = counted(odd.border_edges, "border edge");
    if (odd.misoriented_edges > 0)
        why += (why.empty() ? "" : ", ") + counted(odd.misoriented_edges, "edge") +
               " whose triangles do not face the same way";
    return "not closed: " + why;
}

void write_mesh(std::ostream& out, const Report& report) {
    const auto& mesh = report.mesh;
    out << "mesh      " << counted(report.faces, "face");
    if (mesh.triangles != report.faces) out << " cut into " << counted(mesh.triangles, "triangle");
    out << ", of them " << grouped(mesh.degenerate) << " of zero area and "
        << counted(report.odd.duplicates, "duplicate") << "; " << counted(mesh.vertices, "vertex", "vertices") << "; "
        << openness(report.odd) << '\n';
    if (mesh.broadphase == pierce::Broadphase::grid)
        out << "grid      cells of " << mesh.cell_size << ", " << counted(mesh.grid_references, "reference");
    else
        out << "tree      " << counted(mesh.nodes, "node");
    out << ", " << counted(mesh.clusters, "cluster") << ", " << per(static_cast<double>(mesh.bytes), mesh.triangles)
        << " bytes a triangle\n";
}

void write_queries(std::ostream& out, const Report& report, const Options& options) {
    const auto& counters = report.counters;
    out << "segments  " << counted(report.segments, "segment") << ": " << grouped(report.segments_hit) << " hit, "
        << grouped(report.segments - report.segments_hit) << " missed";
    if (options.question == Question::all) out << ", " << counted(report.hits, "hit") << " in all";
    if (report.mesh.invalid_queries > 0) out << "; " << grouped(report.mesh.invalid_queries) << " not finite";
    out << "\nwork      " << per(static_cast<double>(counters.nodes), report.segments)
        << (report.mesh.broadphase == pierce::Broadphase::grid ? " cells and " : " nodes and ")
        << per(static_cast<double>(counters.triangles), report.segments) << " triangles a segment; "
        << counted(counters.exact_decisions, "exact decision") << ", " << counted(counters.exact_orders, "exact order")
        << ", " << counted(counters.retreats, "point") << " moved back\n";
}

}  // namespace

void write_report(std::ostream& out, const Report& report, const Options& options) {
    write_mesh(out, report);
    write_queries(out, report, options);
    out << "time      read " << duration(report.read_time) << ", built in " << duration(report.build_time)
        << ", cast in " << duration(report.cast_time) << " (" << per(report.cast_time * 1e9, report.segments)
        << " ns a segment, one thread)\n";
    if (options.picture) {
        const auto& picture = *options.picture;
        const auto samples = static_cast<std::uint64_t>(picture.view.samples);
        out << "picture   " << picture.file.string() << ": " << picture.view.width << " x " << picture.view.height
            << " pixels, " << counted(samples * samples, "sample") << " each, in " << duration(report.draw_time) << " ("
            << counted(picture.threads, "thread") << ")\n";
    }
}

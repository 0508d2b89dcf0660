// What a query looked at, and why it hit what it hit: explain() as a picture and as lines for a modeller.
//   visit_view [MESH] [--segment X Y Z X Y Z]        a table: how many faces were refused for which reason
//   visit_view ... --picture visit.png --obj visit.obj
// The picture has the boxes of nodes and clusters on the way to the hit, and the faces whose boxes the segment's box
// meets, in the colours of their reasons.
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <pierce/pierce.h>
#include <CLI/CLI.hpp>

#include "show/demo.h"
#include "show/picture.h"
#include "show/shapes.h"

namespace {

using pierce::Reason;
using Vec3 = Eigen::Vector3f;

struct Style {
    Reason reason;
    show::Colour colour;
    double width;
};
/// What matters most comes last: where two faces share an edge, that is seen. (`apart` is not drawn.)
const std::array k_styles = {Style{Reason::apart, {0.25f, 0.25f, 0.25f}, 1},
                             Style{Reason::zero_area, {1, 0, 1}, 2},
                             Style{Reason::masked, {0.5f, 0.3f, 0.1f}, 1},
                             Style{Reason::in_plane, {0, 0.8f, 0.8f}, 2},
                             Style{Reason::in_front, {0.1f, 0.25f, 0.8f}, 1.5},
                             Style{Reason::behind, {0.35f, 0.1f, 0.6f}, 1.5},
                             Style{Reason::outside_edge, {0.9f, 0.75f, 0.1f}, 1.5},
                             Style{Reason::wrong_side, {0.1f, 0.6f, 0.6f}, 2},
                             Style{Reason::not_accepted, {0.6f, 0.35f, 0.15f}, 2},
                             Style{Reason::too_far, {0.8f, 0.4f, 0.1f}, 2},
                             Style{Reason::later, {1, 0.35f, 0}, 2},
                             Style{Reason::first_hit, {0.1f, 0.9f, 0.1f}, 3}};

constexpr auto k_colours =
    "In the picture: the segment white, the hit a red dot. Boxes on the way: nodes magenta, clusters blue.\n"
    "Faces near it, by their reasons: first hit green, later orange, passes outside an edge yellow,\n"
    "stays behind violet, stays in front blue, from the other side teal, in the segment's plane cyan.";

/// Corners of a box have a bit for each axis: 0 is low, 1 is high.
constexpr std::pair<unsigned, unsigned> k_box_edges[] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                                                         {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
show::Point corner(const pierce::VisitedBox& box, unsigned k) {
    return {(k & 1 ? box.high : box.low).x(), (k & 2 ? box.high : box.low).y(), (k & 4 ? box.high : box.low).z()};
}

struct Query {
    pierce::Segment<float> segment;
    pierce::QueryOptions options;
};

class Visit {
  public:
    Visit(const pierce::TriangleSoup<float>& soup, const pierce::CollisionMesh<float>& mesh, const Query& query)
        : soup_(soup), mesh_(mesh), query_(query), verdicts_(mesh.explain(query.segment, query.options)) {
        query_.options.counters = &counters_;
        hit_ = mesh.first_hit(query.segment, query_.options);
        const double end = std::min(query.options.max_fraction, 1.0);
        boxes_ = pierce::visited_boxes(mesh, query.segment, hit_ ? static_cast<double>(hit_->exact_fraction) : end);
    }

    void print(std::ostream& out) const {
        const auto statistics = mesh_.statistics();
        out << "first_hit went to " << counters_.nodes << " of " << statistics.nodes << " nodes and "
            << counters_.clusters << " of " << statistics.clusters << " clusters of triangles\n"
            << "of " << statistics.triangles << " triangles the wide kernels left " << counters_.triangles
            << " to the filter, and that left " << counters_.exact_decisions << " to exact arithmetic\n";
        if (hit_)
            out << "it hits face " << hit_->face << " at (" << hit_->position << "), fraction " << hit_->exact_fraction
                << '\n';
        else
            out << "it hits nothing\n";
        const auto clusters = std::ranges::count(boxes_, true, &pierce::VisitedBox::is_cluster);
        out << "on the way to it are the boxes of " << boxes_.size() - static_cast<std::size_t>(clusters)
            << " nodes and " << clusters << " clusters\n"
            << "the " << verdicts_.size() << " faces near it, by explain():\n";
        for (const Style& style : k_styles)
            if (const auto count = std::ranges::count(verdicts_, style.reason, &pierce::FaceVerdict::reason))
                out << std::setw(8) << count << "  " << pierce::to_string(style.reason) << '\n';
    }

    void draw(const std::filesystem::path& file, const show::View& view) const {
        // In view is what explain() had to look at more closely than by boxes.
        std::vector<show::Point> points = {query_.segment.from.cast<double>(), query_.segment.to.cast<double>()};
        each_face([&](const pierce::FaceVerdict& verdict, const std::array<show::Point, 3>& corners) {
            if (verdict.reason != Reason::apart) points.insert(points.end(), corners.begin(), corners.end());
        });
        const show::Camera camera(points, view);
        show::Canvas canvas(view);
        const show::Paint paint = {.front = {0.55f, 0.55f, 0.55f}, .back = {0.4f, 0.42f, 0.45f}};
        show::draw(mesh_, camera, canvas, std::max(1u, std::thread::hardware_concurrency()), paint);
        std::vector<show::Line> lines;
        for (const Style& style : k_styles)
            each_face([&](const pierce::FaceVerdict& verdict, const std::array<show::Point, 3>& corners) {
                if (verdict.reason != style.reason || style.reason == Reason::apart) return;
                const bool on_top = style.reason == Reason::first_hit || style.reason == Reason::later;
                for (std::size_t k = 0; k < 3; ++k)
                    lines.push_back({corners[k], corners[(k + 1) % 3], style.colour, style.width, on_top});
            });
        for (const pierce::VisitedBox& box : boxes_) {
            const show::Colour colour = box.is_cluster ? show::Colour(0.1f, 0.6f, 1) : show::Colour(0.9f, 0.1f, 0.5f);
            for (const auto& [from, to] : k_box_edges)
                lines.push_back({corner(box, from), corner(box, to), colour, box.is_cluster ? 2.0 : 1.0, true});
        }
        lines.push_back({points[0], points[1], {1, 1, 1}, 2, true});
        canvas.draw(camera, lines);
        if (hit_) {
            const double size = 0.015 * (points[1] - points[0]).norm();
            canvas.draw(camera, std::vector<show::Dot>{{hit_->position.vec().cast<double>(), {1, 0.1f, 0.1f}, size}});
        }
        show::write_png(file, canvas.image());
    }

    /// The segment, for each reason a group of outlines, and the boxes of nodes and clusters.
    void write_obj(const std::filesystem::path& path) const {
        std::ofstream file(path);
        file << std::setprecision(9);
        std::size_t count = 0;
        const auto write_vertex = [&](const show::Point& p) {
            file << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
            return ++count;
        };
        file << "# outlines of the faces near a segment, a group for each reason; boxes\ng segment\n";
        write_vertex(query_.segment.from.cast<double>());
        write_vertex(query_.segment.to.cast<double>());
        file << "l 1 2\n";
        for (const Style& style : k_styles) {
            bool is_first = true;
            each_face([&](const pierce::FaceVerdict& verdict, const std::array<show::Point, 3>& corners) {
                if (verdict.reason != style.reason) return;
                if (is_first) {
                    std::string name(pierce::to_string(style.reason));
                    std::ranges::replace(name, ' ', '_');
                    file << "g " << name << '\n';
                }
                is_first = false;
                for (const show::Point& corner : corners) write_vertex(corner);
                file << "l " << count - 2 << ' ' << count - 1 << ' ' << count << ' ' << count - 2 << '\n';
            });
        }
        for (const bool is_cluster : {false, true}) {
            file << (is_cluster ? "g clusters\n" : "g nodes\n");
            for (const pierce::VisitedBox& box : boxes_) {
                if (box.is_cluster != is_cluster) continue;
                const std::size_t first = count + 1;
                for (unsigned k = 0; k < 8; ++k) write_vertex(corner(box, k));
                for (const auto& [from, to] : k_box_edges) file << "l " << first + from << ' ' << first + to << '\n';
            }
        }
        file.close();
        if (!file) throw std::runtime_error(path.string() + ": can't be written");
    }

  private:
    template <class Use>
    void each_face(Use&& use) const {
        for (const pierce::FaceVerdict& verdict : verdicts_) {
            std::array<show::Point, 3> corners;
            for (std::size_t k = 0; k < 3; ++k)
                corners[k] = soup_.positions[soup_.triangles[verdict.triangle][k]].cast<double>();
            use(verdict, corners);
        }
    }

    const pierce::TriangleSoup<float>& soup_;
    const pierce::CollisionMesh<float>& mesh_;
    Query query_;
    std::vector<pierce::FaceVerdict> verdicts_;
    pierce::QueryCounters counters_;
    std::optional<pierce::Hit<float>> hit_;
    std::vector<pierce::VisitedBox> boxes_;
};

}  // namespace

int main(int argc, char** argv) {
    std::filesystem::path mesh_file, picture, obj;
    std::vector<float> ends;
    Query query;
    show::View view;
    view.azimuth = 70;
    CLI::App app("What a query looked at, and why it hit what it hit.", "visit_view");
    app.footer(k_colours);
    app.add_option("MESH", mesh_file, "A mesh: OBJ, OFF, PLY or STL; else a bumpy sphere of radius 1 is made")
        ->option_text(" ");
    app.add_option("--segment", ends, "From where to where; else through the middle of the mesh")
        ->expected(6)
        ->check(show::finite)
        ->option_text("X Y Z X Y Z");
    app.add_option("--sides", query.options.sides, "Which sides of faces count: front, back or both (front)")
        ->transform(CLI::Transformer(std::map<std::string, pierce::Sides>{
            {"front", pierce::Sides::front}, {"back", pierce::Sides::back}, {"both", pierce::Sides::both}}))
        ->option_text("SIDES");
    app.add_option("--max-fraction", query.options.max_fraction, "Hits count up to this fraction of the segment")
        ->check(show::finite)
        ->option_text("F");
    app.add_option("--picture", picture, "Draw it into this PNG file")->option_text("FILE");
    app.add_option("--obj", obj, "Write it as lines into this OBJ file")->option_text("FILE");
    show::add_view_options(app, view);
    CLI11_PARSE(app, argc, argv);
    try {
        const auto soup = show::mesh_or(mesh_file, show::bumpy_sphere(16));
        const pierce::CollisionMesh<float> mesh(soup.view());
        if (ends.empty()) {
            Eigen::AlignedBox3f box;
            for (const Vec3& position : soup.positions) box.extend(position);
            // A flat mesh is crossed as well.
            const Vec3 size = box.diagonal().cwiseMax(0.1f * box.diagonal().norm());
            const Vec3 way = 0.6f * size.cwiseProduct(Vec3(1, 0.3f, 0.2f));
            query.segment = {box.center() + way, box.center() - way};
        } else {
            query.segment = {Vec3(ends[0], ends[1], ends[2]), Vec3(ends[3], ends[4], ends[5])};
        }
        const Visit visit(soup, mesh, query);
        visit.print(std::cout);
        if (!picture.empty()) visit.draw(picture, view);
        if (!obj.empty()) visit.write_obj(obj);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "visit_view: " << error.what() << '\n';
        return 2;
    }
}

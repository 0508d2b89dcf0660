// How fast is pierce, and how fast are its peers? On the same segments, in one process.
//   speed [--quick] [--large] [--seconds S] [--out FOLDER] [FILTER]
// Prints Markdown, and at its end lines `ratio NAME VALUE`. Ends with status 1 if answers differ that must not.
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

#include "../peers.h"
#include "agreement.h"
#include "builds.h"
#include "measure.h"
#include "memory.h"
#include "plan.h"
#include "report.h"

namespace pierce::bench {
namespace {

struct Options {
    bool quick = false;
    bool large = false;
    double seconds = 0;  ///< for each figure, at most; 0: not said
    std::string out = ".";
    std::string filter;  ///< only what has it in its `mesh/set`
};

Options parse(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        const auto value = [&]() -> std::string {
            if (++i == argc) throw std::invalid_argument(argument + " needs a value");
            return argv[i];
        };
        if (argument == "--quick")
            options.quick = true;
        else if (argument == "--large")
            options.large = true;
        else if (argument == "--seconds")
            options.seconds = std::stod(value());
        else if (argument == "--out")
            options.out = value();
        else if (argument.starts_with('-') || !options.filter.empty())
            throw std::invalid_argument("usage: speed [--quick] [--large] [--seconds S] [--out FOLDER] [FILTER]");
        else
            options.filter = argument;
    }
    if (!options.quick) options.large = true;
    if (options.seconds <= 0) options.seconds = options.quick ? 0.06 : 0.5;
    return options;
}

class Suite {
  public:
    explicit Suite(const Options& options)
        : options_(options),
          plan_{options.quick},
          effort_{.segments = options.quick ? 40'000U : 200'000U,
                  .seconds = options.seconds,
                  .repetitions = options.quick ? 5 : 7} {}

    /// Returns whether answers agreed.
    bool run() {
        const auto meshes = bench_meshes(options_.large);
        print_head(meshes);
        for (const BenchMesh& mesh : meshes)  // first, while this process is small
            if (mesh.divisions >= 1000 && selected(mesh, "peak")) measure_peak(mesh);
        for (const BenchMesh& mesh : meshes) measure_mesh(mesh);
        const bool agreed = agreement_.report();
        print_figures(results_, measured_);
        std::map<std::string, std::size_t, std::less<>> faces;
        for (const Measured& m : measured_) faces[m.mesh.name] = m.faces;
        results_.write(options_.out + "/speed.tsv", faces);
        print_ratios(results_, measured_);
        return agreed;
    }

  private:
    [[nodiscard]] bool selected(const BenchMesh& mesh, std::string_view set) const {
        return (mesh.name + '/' + std::string(set)).find(options_.filter) != std::string::npos;
    }

    void print_head(const std::vector<BenchMesh>& meshes) const {
        std::cout << "Embree " << embree_version() << ", Bullet " << bullet_version() << ", CGAL " << cgal_version()
                  << ", as Debian builds them.\n\n"
                  << k_columns_text << "\nMedians of " << effort_.repetitions << " interleaved repetitions, of up to "
                  << effort_.segments << " segments each, or " << effort_.seconds
                  << " s for a figure. Medians over meshes are over:";
        for (const BenchMesh& mesh : meshes)
            if (mesh.kind == MeshKind::real) std::cout << ' ' << mesh.name;
        std::cout << "\n\n" << std::flush;
    }

    void measure_mesh(const BenchMesh& mesh) {
        std::vector<SegmentSet> sets;
        for (const SegmentSet set : k_segment_sets)
            if (plan_.wanted(mesh, set) && selected(mesh, name_of(set))) sets.push_back(set);
        const bool builds = selected(mesh, set_name::build_fresh) || selected(mesh, set_name::thread_build);
        const bool memory = selected(mesh, set_name::memory);
        const bool threads = selected(mesh, set_name::threads) && mesh.kind != MeshKind::sphere;
        if (sets.empty() && !builds && !memory && !threads) return;
        const double start = seconds_now(Clock::wall);
        const TriangleSoup<float> soup = mesh.load();
        measured_.push_back({mesh, soup.triangles.size()});
        if (builds) measure_builds(mesh.name, soup.view(), effort_.repetitions, results_);
        if (memory) measure_memory(mesh.name, soup.view(), results_);
        if (threads) measure_threads(mesh.name, soup.view(), effort_, results_);
        if (!sets.empty()) measure_queries(mesh, soup, sets);
        std::cerr << mesh.name << ": " << soup.triangles.size() << " faces, " << seconds_now(Clock::wall) - start
                  << " s\n";
    }

    void measure_queries(const BenchMesh& mesh, const TriangleSoup<float>& soup, const std::vector<SegmentSet>& sets) {
        Columns columns;
        add_pierce_columns<float>(columns, std::make_shared<const CollisionMesh<float>>(soup.view()));
        add_embree_columns(columns, soup.view(), plan_.all_columns(mesh));
        add_grid_columns(columns, soup.view());
        if (plan_.all_columns(mesh)) {
            std::vector<Vec3<double>> positions;
            for (const Vec3<float>& p : soup.positions) positions.push_back(p.cast<double>());
            add_pierce_columns<double>(columns, std::make_shared<const CollisionMesh<double>>(
                                                    MeshView<double>{positions, soup.triangles, soup.faces}));
            add_bullet_column(columns, soup.view());
            add_cgal_columns(columns, soup.view());
        }
        for (const SegmentSet set : sets) {
            const auto segments = make_segments(set, soup.view(), effort_.segments);
            std::vector<Column*> asked;
            for (const auto& c : columns) {
                c->prepare(segments);
                if (plan_.wanted(set, c->name())) asked.push_back(c.get());
            }
            agreement_.compare(mesh.name, name_of(set), columns, segments.size() / 10, options_.seconds);
            measure(asked, effort_, Clock::thread,
                    [&](std::string_view column, double ns) { results_.add(mesh.name, name_of(set), column, ns); });
        }
    }

    Options options_;
    Plan plan_;
    Effort effort_;
    Agreement agreement_;
    Results results_;
    std::vector<Measured> measured_;
};

}  // namespace
}  // namespace pierce::bench

int main(int argc, char** argv) {
    try {
        return pierce::bench::Suite(pierce::bench::parse(argc, argv)).run() ? 0 : 1;
    } catch (const std::exception& error) {
        std::cerr << "speed: " << error.what() << '\n';
        return 2;
    }
}

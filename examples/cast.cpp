// Reads a mesh, casts segments at it, prints where they hit, what the mesh is like and how long it took, and draws a
// picture on request. `cast --help` lists the options. The library is used in `run` below and in cast/answers.cpp.
#include <chrono>
#include <fstream>
#include <iostream>
#include <limits>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include <pierce/pierce.h>

#include "cast/answers.h"
#include "cast/numbers.h"
#include "cast/options.h"
#include "cast/progress.h"
#include "cast/report.h"
#include "cast/segments.h"
#include "show/image.h"
#include "show/picture.h"

namespace {

/// What `work` returns; adds the seconds that it took to `seconds`.
template <class Work>
auto timed(double& seconds, Work work) {
    const auto start = std::chrono::steady_clock::now();
    auto result = work();
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

/// A file that is opened before the work whose result goes into it: what can't be written is better known at once.
class OutputFile {
  public:
    explicit OutputFile(const std::filesystem::path& path) : path_(path), stream_(path, std::ios::binary) {
        if (!stream_) throw InputError(path_.string() + ": can't be written");
    }

    std::ostream& stream() { return stream_; }

    void close() {
        stream_.close();
        if (!stream_) throw InputError(path_.string() + ": could not be written in full");
    }

  private:
    std::filesystem::path path_;
    std::ofstream stream_;
};

template <class Scalar>
show::Image draw(const pierce::CollisionMesh<Scalar>& mesh, const pierce::TriangleSoup<Scalar>& soup,
                 const PictureOptions& options) {
    const show::Camera camera(show::corners_of(soup), options.view);
    show::Canvas canvas(options.view);
    Progress progress("drawing", static_cast<std::uint64_t>(canvas.rows()));
    try {
        show::draw(mesh, camera, canvas, options.threads, {}, [&] { progress.add(1); });
        return canvas.image();
    } catch (const std::runtime_error& error) {
        throw InputError(std::string("cast: ") + error.what());
    }
}

template <class Scalar>
void run(const Options& options) {
    Report report;
    const auto soup = timed(report.read_time, [&] {
        const Progress progress("reading");
        return pierce::read_mesh<Scalar>(options.mesh);
    });
    const auto mesh = timed(report.build_time, [&] {
        const Progress progress("building");
        return pierce::CollisionMesh<Scalar>(soup.view());
    });
    const auto segments = [&] {
        const Progress progress("segments");
        return collect_segments(options, soup);
    }();

    const bool csv_to_file = options.csv && *options.csv != "-";
    std::optional<OutputFile> csv_file, picture_file;
    if (csv_to_file) csv_file.emplace(*options.csv);
    if (options.picture) picture_file.emplace(options.picture->file);

    const auto answers = timed(report.cast_time, [&] {
        Progress progress("casting", segments.size());
        return ask(mesh, std::span(segments), options, progress);
    });
    if (csv_to_file) {
        const Progress progress("writing");
        write_csv(csv_file->stream(), answers);
        csv_file->close();
    } else if (options.csv) {
        write_csv(std::cout, answers);
    } else {
        constexpr std::size_t most_rows = 20;
        write_table(std::cout, answers, options.all_rows ? std::numeric_limits<std::size_t>::max() : most_rows);
        std::cout << '\n';
    }

    report.faces = soup.face_count();
    report.mesh = mesh.statistics();
    report.odd = mesh.mesh_report();
    report.counters = answers.counters;
    report.segments = segments.size();
    report.segments_hit = answers.segments_hit;
    report.hits = answers.hits;
    if (options.picture) {
        const auto image = timed(report.draw_time, [&] { return draw(mesh, soup, *options.picture); });
        picture_file->stream() << show::to_png(image);
        picture_file->close();
    }
    // A program that reads the CSV does not want the rest.
    write_report(options.csv && !csv_to_file ? std::cerr : std::cout, report, options);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const auto options = read_options(argc, argv);
        if (options) options->in_float ? run<float>(*options) : run<double>(*options);
        if (!std::cout.flush()) throw InputError("cast: can't write to standard output");
        return 0;
    } catch (const std::bad_alloc&) {
        std::cerr << "cast: not enough memory\n";
    } catch (const std::exception& error) {  // pierce::MeshError and InputError: each a line that is complete
        std::cerr << error.what() << '\n';
    }
    return 2;
}

// A long run of particles through a closed vessel, on as many processes as there are (MPI), of as many threads each:
//   mpirun -n 4 mpi_tracking MESH --particles 10000000 --checkpoint run.ckpt
// After a crash the same command goes on from run.ckpt, also with another number of ranks. The result, and the hash
// that is printed, are those of one rank that is never interrupted, to the last bit. Ends with status 0, with 1 if a
// particle left the mesh, with 2 for an error. examples/guide/mpi.md says more.
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <future>
#include <iostream>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <pierce/pierce.h>
#include <CLI/CLI.hpp>

#include "mpi_tracking/checkpoint.h"
#include "mpi_tracking/flights.h"
#include "mpi_tracking/ranks.h"
#include "mpi_tracking/tallies.h"
#include "mpi_tracking/vessel.h"
#include "mpi_tracking/work.h"
#include "show/shapes.h"

namespace {

using namespace tracking;

struct Options {
    std::filesystem::path mesh;
    Physics physics;
    std::uint64_t particles = 1'000'000;
    std::uint64_t batch = 1024;
    unsigned threads = 1;
    bool check_all = false;
    std::filesystem::path checkpoint;
    double seconds = 60;
    std::filesystem::path faces;
};

void add_options(CLI::App& app, Options& options) {
    app.add_option("MESH", options.mesh, "A closed mesh: OBJ, OFF, PLY or STL; else one is made");
    app.add_option("--particles", options.particles, "How many (1000000)")->check(CLI::Range(1.0, 1e12));
    app.add_option("--stick", options.physics.sticking, "The part of the hits that end a particle (0.1)")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--most-hits", options.physics.most_hits, "After which a particle is stopped (1000)")
        ->check(CLI::Range(1, 1'000'000'000));
    app.add_option("--seed", options.physics.seed, "Another one, other particles (1)");
    app.add_option("--batch", options.batch, "Particles that a thread takes at a time (1024)")
        ->check(CLI::Range(1, 1'000'000));
    app.add_option("--threads", options.threads, "For each rank (1)")->check(CLI::Range(1, 1024));
    app.add_flag("--check", options.check_all,
                 "Ask after every flight whether the particle is in the mesh, not only in the end");
    app.add_option("--checkpoint", options.checkpoint, "A file: go on from it if it is there, and keep it up to date");
    app.add_option("--every", options.seconds, "Seconds from one checkpoint to the next (60)")
        ->check(CLI::PositiveNumber);
    app.add_option("--faces", options.faces, "Write a CSV file: hits and absorbed particles of each face");
}

/// That of rank 0, which alone reads the file.
Vessel read_vessel(const Ranks& ranks, const Options& options) {
    pierce::TriangleSoup<double> soup;
    ranks.first_does([&] {
        if (!options.mesh.empty()) {
            soup = pierce::read_mesh<double>(options.mesh);
            return;
        }
        const pierce::TriangleSoup<float> made = show::bumpy_sphere(80);
        for (const Eigen::Vector3f& position : made.positions) soup.positions.push_back(position.cast<double>());
        soup.triangles = made.triangles;
    });
    broadcast(soup);
    return Vessel(std::move(soup));
}

/// Where the time of this rank went, in seconds.
struct Times {
    double flying = 0;  ///< of all threads, as far as they had a processor
    double all = 0;     ///< by the clock
};

/// Of the calling thread, on whatever processor.
double cpu_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Flies on all threads of this rank until the round is over, and sums up in the first one's tallies. Returns the
/// seconds that the threads were flying.
double fly_round(Work& work, std::vector<Flights>& flights, std::vector<Tallies>& tallies) {
    std::vector<double> seconds(flights.size());
    const auto fly = [&](std::size_t thread) {
        try {
            for (auto part = work.take(); part.count > 0; part = work.take()) {
                const double start = cpu_seconds();
                flights[thread].fly(part.first, part.count, tallies[thread]);
                seconds[thread] += cpu_seconds() - start;
            }
        } catch (const std::exception& error) {
            Ranks::end_all(error.what());
        }
    };
    {
        std::vector<std::jthread> helpers;
        for (std::size_t i = 1; i < flights.size(); ++i) helpers.emplace_back(fly, i);
        fly(0);
    }
    for (std::size_t i = 1; i < tallies.size(); ++i) {
        tallies[0] += tallies[i];
        tallies[i].clear();
    }
    return std::accumulate(seconds.begin(), seconds.end(), 0.0);
}

/// Flies all particles that are not in `total` yet, and adds them there on rank 0; others need no room in `total`.
Times fly_all(const Ranks& ranks, const Options& options, const RunIdentity& run,
              const pierce::CollisionMesh<double>& mesh, const Vessel& vessel, Tallies& total) {
    std::uint64_t done = total[Sum::particles];
    broadcast(done);
    Work work(ranks, done, options.particles, options.batch, options.threads);
    std::vector<Flights> flights(options.threads, Flights(mesh, vessel, options.physics, options.check_all));
    std::vector<Tallies> tallies(options.threads, Tallies(vessel.soup().face_count()));
    Tallies round(total.faces());
    const bool has_checkpoint = !options.checkpoint.empty();
    // A thread of its own on rank 0 writes files, so that nobody waits for the disk. `total` stays as it is meanwhile.
    const auto keep = [&] {
        try {
            write_checkpoint(options.checkpoint, run, total);
            std::cerr << total[Sum::particles] << " of " << options.particles << " particles are done and kept\n";
        } catch (const std::exception& error) {
            std::cerr << "mpi_tracking: " << error.what() << "; the run goes on without a new checkpoint\n";
        }
    };
    std::future<void> writing;
    Times times;
    const double start = MPI_Wtime();
    while (done < options.particles) {
        work.begin(has_checkpoint ? options.seconds : std::numeric_limits<double>::infinity());
        times.flying += fly_round(work, flights, tallies);
        work.end();
        // All finish what they have been given. So those that are done are the first ones, without a gap.
        sum(tallies[0].words(), round.words());
        tallies[0].clear();
        if (writing.valid()) writing.wait();
        if (ranks.is_first()) {
            total += round;
            done = total[Sum::particles];
        }
        broadcast(done);
        if (ranks.is_first() && has_checkpoint) writing = std::async(std::launch::async, keep);
    }
    if (writing.valid()) writing.wait();
    times.all = MPI_Wtime() - start;
    return times;
}

void write_faces(const std::filesystem::path& path, Tallies& total) {
    std::ofstream file(path);
    file << "face,hits,absorbed\n";
    for (std::size_t face = 0; face < total.faces(); ++face)
        file << face << ',' << total.hits(face) << ',' << total.absorbed(face) << '\n';
    if (!file.flush()) throw std::runtime_error(path.string() + ": can't be written");
}

/// What rank 0 says in the end.
void print(const Vessel& vessel, const Tallies& total) {
    const double mean = static_cast<double>(total[Sum::length]) / static_cast<double>(total[Sum::flights]);
    std::cout << "particles  " << total[Sum::particles] << ": " << total[Sum::absorbed] << " absorbed, "
              << total[Sum::stopped] << " stopped, " << total[Sum::lost] << " lost, " << total[Sum::outside]
              << " outside of the mesh\n"
              << "flights    " << total[Sum::flights] << " of " << mean * vessel.length_unit()
              << " on average, expected " << vessel.mean_chord() << '\n'
              << "hash       " << total.hash().to_string() << '\n';
}

int run(const Ranks& ranks, const Options& options) {
    const double start = MPI_Wtime();
    const Vessel vessel = read_vessel(ranks, options);
    const pierce::CollisionMesh<double> mesh(vessel.soup().view());
    const double built = MPI_Wtime();

    const RunIdentity identity{vessel.hash(), options.physics};
    Tallies total(ranks.is_first() ? vessel.soup().face_count() : 0);
    ranks.first_does([&] {
        if (!mesh.mesh_report().closed()) throw std::runtime_error("the mesh is not closed");
        if (!vessel.has_inside()) throw std::runtime_error("the mesh has no inside");
        if (const auto kept = read_checkpoint(options.checkpoint, identity, total.faces())) total = *kept;
        if (total[Sum::particles] > options.particles)
            throw std::runtime_error("the checkpoint has more than --particles already");
        std::cout << "mesh       " << total.faces() << " faces, closed, read and built in " << built - start << " s, "
                  << static_cast<double>(mesh.statistics().bytes) * 1e-6 << " MB a rank\n"
                  << "ranks      " << ranks.size() << ", threads of each " << options.threads << ", from particle "
                  << total[Sum::particles] << " on\n"
                  << std::flush;
    });
    const std::uint64_t flights_before = total[Sum::flights];
    const Times times = fly_all(ranks, options, identity, mesh, vessel, total);
    const double flying = sum(times.flying), all = sum(times.all);
    if (!ranks.is_first()) return 0;
    const auto flights = static_cast<double>(total[Sum::flights] - flights_before);
    if (flights > 0)
        std::cout << "time       " << times.all << " s, " << flying * 1e9 / flights
                  << " ns of a processor for a flight; threads did not fly for "
                  << 100 * (1 - flying / (all * options.threads)) << " % of the time\n";
    print(vessel, total);
    if (!options.faces.empty()) write_faces(options.faces, total);
    return total[Sum::lost] + total[Sum::outside] == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    const Ranks ranks(argc, argv);
    Options options;
    CLI::App app("Particles fly through a closed vessel, on any number of MPI ranks.", "mpi_tracking");
    add_options(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {  // all ranks see the same, one says it
        std::ostringstream nowhere;
        const int code = ranks.is_first() ? app.exit(error) : app.exit(error, nowhere, nowhere);
        return code == 0 ? 0 : 2;  // --help is no error
    }
    try {
        return run(ranks, options);
    } catch (const Ranks::Failed&) {
        return ranks.is_first() ? 2 : 0;  // one status is enough for mpirun
    } catch (const std::exception& error) {
        Ranks::end_all(error.what());
    }
}

// How many particles are lost in a number of flights through the nested model of the tests, and how fast they fly.
//   region_flights [COUNT [THREADS [SEED]]]
// COUNT flights with each Scalar, a million if it is not given. Ends with status 1 if any particle is lost.
#include <chrono>
#include <iostream>
#include <string>

#include <support/region_flights.h>

namespace {

using namespace pierce;
using namespace pierce::test;

template <class Scalar>
bool measure(const char* name, std::uint64_t count, unsigned threads, std::uint64_t seed) {
    const auto model = nested_model(12, 3).as<Scalar>(1, Vec3<double>(0, 0, 0));
    const CollisionMesh<Scalar> mesh(model.soup.view());
    const Regions<Scalar> regions(mesh, model.labels);
    const auto start = std::chrono::steady_clock::now();
    const FlightTally tally = fly(model, regions, count, seed, threads);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    std::cout << name << ": " << tally.flights << " flights, " << model.soup.triangles.size() << " faces, lost "
              << tally.lost << ", in a wrong region " << tally.wrong << "; " << tally.crossings << " crossings, "
              << tally.thin << " of them to no next region, " << tally.stops << " stops; "
              << static_cast<std::uint64_t>(static_cast<double>(tally.flights) / taken.count()) << " a second\n"
              << std::flush;
    return tally.lost == 0 && tally.wrong == 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::uint64_t count = argc > 1 ? std::stoull(argv[1]) : 1'000'000;
        const auto threads = static_cast<unsigned>(argc > 2 ? std::stoul(argv[2]) : 1);
        const std::uint64_t seed = argc > 3 ? std::stoull(argv[3]) : 1;
        if (argc > 4 || threads == 0) throw std::invalid_argument("too many");
        const bool floats = measure<float>("float", count, threads, seed);
        const bool doubles = measure<double>("double", count, threads, seed);
        return floats && doubles ? 0 : 1;
    } catch (const std::exception&) {
        std::cerr << "usage: region_flights [COUNT [THREADS [SEED]]]\n";
        return 2;
    }
}

// See ranks.h. Errors of MPI itself end the program, as MPI does unless told otherwise.
#include "mpi_tracking/ranks.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <thread>
#include <vector>

namespace tracking {

namespace {

/// In parts, for MPI counts in int.
template <class Element>
void broadcast_elements(std::vector<Element>& elements) {
    std::uint64_t size = elements.size();
    broadcast(size);
    elements.resize(size);
    auto* bytes = reinterpret_cast<std::byte*>(elements.data());
    constexpr std::size_t k_part = std::size_t{1} << 30;
    for (std::size_t left = size * sizeof(Element), part = 0; left > 0; left -= part, bytes += part) {
        part = std::min(left, k_part);
        MPI_Bcast(bytes, static_cast<int>(part), MPI_BYTE, 0, MPI_COMM_WORLD);
    }
}

}  // namespace

Ranks::Ranks(int& argc, char**& argv) {
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
    if (provided < MPI_THREAD_SERIALIZED) throw std::runtime_error("this MPI can't be called from several threads");
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Ranks::~Ranks() { MPI_Finalize(); }

void Ranks::say(const std::string& what) { std::cerr << "mpi_tracking: " << what << std::endl; }

void Ranks::end_all(const std::string& why) {
    say(why);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));  // mpirun may drop what it has not passed on by then
    MPI_Abort(MPI_COMM_WORLD, 2);
    std::abort();  // MPI_Abort does not return, but does not say so
}

void broadcast(std::uint64_t& number) { MPI_Bcast(&number, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD); }

void broadcast(pierce::TriangleSoup<double>& soup) {
    static_assert(sizeof(pierce::Vec3<double>) == 3 * sizeof(double));
    broadcast_elements(soup.positions);
    broadcast_elements(soup.triangles);
    broadcast_elements(soup.faces);
}

void sum(std::span<const std::uint64_t> mine, std::span<std::uint64_t> total) {
    // A mesh has fewer than 2^28 faces, so the count fits.
    MPI_Reduce(mine.data(), total.data(), static_cast<int>(mine.size()), MPI_UINT64_T, MPI_SUM, 0, MPI_COMM_WORLD);
}

double sum(double mine) {
    double total = 0;
    MPI_Reduce(&mine, &total, 1, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
    return total;
}

}  // namespace tracking

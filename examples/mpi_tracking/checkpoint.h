// The state of a run in a file: which particles are done, and their tallies. It does not depend on how many ranks there
// are, nor on how they share the work.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "mpi_tracking/flights.h"
#include "mpi_tracking/hash.h"
#include "mpi_tracking/tallies.h"

namespace tracking {

/// What two runs must have in common for one to go on with the tallies of the other. (Not how many particles they are
/// to have: a run may be made longer.)
struct RunIdentity {
    Hash mesh;
    Physics physics;
};

/// Replaces the file by one with these tallies: whoever reads it, at any time, has the old one or the new one, also
/// after a crash. Throws std::runtime_error, and the old one stays.
void write_checkpoint(const std::filesystem::path& path, const RunIdentity& run, const Tallies& tallies);

/// Nothing if there is no such file. Throws std::runtime_error, one line that names the file and the reason, where it
/// can't be read, is cut short or damaged, or belongs to another run.
std::optional<Tallies> read_checkpoint(const std::filesystem::path& path, const RunIdentity& run, std::size_t faces);

}  // namespace tracking

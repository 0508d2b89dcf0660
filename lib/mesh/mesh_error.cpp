// The one place where the class of errors lives, and where those of the public headers are thrown.
#include <pierce/mesh_error.h>

#include <pierce/points_view.h>

namespace pierce {

MeshError::~MeshError() = default;

void throw_mesh_error(const std::string& text) { throw MeshError(text); }

void throw_rows_error(std::ptrdiff_t rows) {
    throw std::invalid_argument("points are the columns of a matrix with 3 rows, not " + std::to_string(rows));
}

}  // namespace pierce

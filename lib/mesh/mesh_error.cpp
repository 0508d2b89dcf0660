// The one place where the class of errors lives, and where those of the public headers are thrown.
#include <pierce/mesh_error.h>

namespace pierce {

MeshError::~MeshError() = default;

void throw_mesh_error(const std::string& text) { throw MeshError(text); }

}  // namespace pierce

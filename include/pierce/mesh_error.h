// The error that a mesh, or a mesh file, is refused with.
#pragma once

#include <stdexcept>
#include <string>

#include <pierce/export.h>

namespace pierce {

/// A mesh, or a mesh file, that can't be used. `what()` is one line that names the file and its line or byte, or the
/// vertex or face, and the reason.
class PIERCE_EXPORT MeshError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    MeshError(const MeshError&) = default;
    MeshError& operator=(const MeshError&) = default;
    // Defined in the library, and with it the type information: code compiled without it (-fno-rtti) makes no second
    // copy of the class.
    ~MeshError() override;
};

/// Throws `MeshError(text)`, from within the library. Headers have no `throw` of their own, so they compile without
/// exceptions (-fno-exceptions). An error that code so compiled meets is thrown all the same. Where nobody catches it,
/// the program ends (std::terminate). A caller further up that was compiled with exceptions catches it, with GCC and
/// Clang on Linux; but what lies between is left without its destructors being called.
[[noreturn]] PIERCE_EXPORT void throw_mesh_error(const std::string& text);

}  // namespace pierce

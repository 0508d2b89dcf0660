// The door to the readers: tells the kind of a file from the ending of its name.
#include <algorithm>
#include <string>

#include <pierce/triangle_soup.h>

#include "environment.h"
#include "mesh/read_formats.h"
#include "mesh/read_packed.h"
#include "mesh/read_source.h"

namespace pierce {
namespace {

std::string ending_of(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return ending;
}

}  // namespace

template <class Scalar>
TriangleSoup<Scalar> read_mesh(const std::filesystem::path& path, const ReadOptions& options) {
    const detail::SourceFile file(path);
    const std::string ending = ending_of(path);
    const detail::StandardArithmetic standard;
    if (ending == ".stl") {
        return detail::read_stl<Scalar>(file, options);
    }
    detail::refuse_packed(file);
    if (ending == ".obj") {
        return detail::read_obj<Scalar>(file, options);
    }
    if (ending == ".off") {
        return detail::read_off<Scalar>(file, options);
    }
    if (ending == ".ply") {
        return detail::read_ply<Scalar>(file, options);
    }
    file.fail("the ending " + detail::quoted(ending) + " is not one of .obj, .off, .ply and .stl");
}

template TriangleSoup<float> read_mesh<float>(const std::filesystem::path&, const ReadOptions&);
template TriangleSoup<double> read_mesh<double>(const std::filesystem::path&, const ReadOptions&);

}  // namespace pierce

// The reader of each file format: takes the file in memory, gives the mesh or throws. Behind a call that the compiler
// does not inline: read_mesh has made the arithmetic standard (environment.h), in which numbers are rounded to `Scalar`
// and polygons are cut.
#pragma once

#include <pierce/triangle_soup.h>

#include "mesh/read_source.h"

namespace pierce::detail {

template <class Scalar>
[[nodiscard]] [[gnu::noinline]] TriangleSoup<Scalar> read_obj(const SourceFile& file);
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] TriangleSoup<Scalar> read_off(const SourceFile& file);
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] TriangleSoup<Scalar> read_ply(const SourceFile& file);
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] TriangleSoup<Scalar> read_stl(const SourceFile& file);

extern template TriangleSoup<float> read_obj<float>(const SourceFile&);
extern template TriangleSoup<double> read_obj<double>(const SourceFile&);
extern template TriangleSoup<float> read_off<float>(const SourceFile&);
extern template TriangleSoup<double> read_off<double>(const SourceFile&);
extern template TriangleSoup<float> read_ply<float>(const SourceFile&);
extern template TriangleSoup<double> read_ply<double>(const SourceFile&);
extern template TriangleSoup<float> read_stl<float>(const SourceFile&);
extern template TriangleSoup<double> read_stl<double>(const SourceFile&);

}  // namespace pierce::detail

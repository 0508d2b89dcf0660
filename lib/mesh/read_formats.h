// The reader of each file format: takes the file in memory, gives the mesh or throws. Behind a call that the compiler
// does not inline: read_mesh has made the arithmetic standard (environment.h), in which numbers are rounded to `Scalar`
// and polygons are cut.
#pragma once

#include <pierce/triangle_soup.h>

#include "mesh/read_source.h"

namespace pierce::detail {

template <class Scalar>
[[nodiscard]] [[gnu::noinline]] TriangleSoup<Scalar> read_obj(const SourceFile& file, const ReadOptions& options);
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] TriangleSoup<Scalar> read_off(const SourceFile& file, const ReadOptions& options);
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] TriangleSoup<Scalar> read_ply(const SourceFile& file, const ReadOptions& options);
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] TriangleSoup<Scalar> read_stl(const SourceFile& file, const ReadOptions& options);

extern template TriangleSoup<float> read_obj<float>(const SourceFile&, const ReadOptions&);
extern template TriangleSoup<double> read_obj<double>(const SourceFile&, const ReadOptions&);
extern template TriangleSoup<float> read_off<float>(const SourceFile&, const ReadOptions&);
extern template TriangleSoup<double> read_off<double>(const SourceFile&, const ReadOptions&);
extern template TriangleSoup<float> read_ply<float>(const SourceFile&, const ReadOptions&);
extern template TriangleSoup<double> read_ply<double>(const SourceFile&, const ReadOptions&);
extern template TriangleSoup<float> read_stl<float>(const SourceFile&, const ReadOptions&);
extern template TriangleSoup<double> read_stl<double>(const SourceFile&, const ReadOptions&);

}  // namespace pierce::detail

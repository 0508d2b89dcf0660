// The segments that are cast: read from a file, from the command line, or made up.
#pragma once

#include <vector>

#include <pierce/triangle_soup.h>
#include <pierce/types.h>

#include "cast/options.h"

/// Those of the file, those of the command line, those made up, in this order. Throws InputError.
template <class Scalar>
std::vector<pierce::Segment<Scalar>> collect_segments(const Options& options, const pierce::TriangleSoup<Scalar>& soup);

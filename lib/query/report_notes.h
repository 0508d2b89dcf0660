// A case of what a mesh report counts.
#pragma once

#include <pierce/mesh_report.h>

namespace pierce::detail {

/// The first few are kept as examples.
template <class T>
void note(std::size_t& count, std::vector<T>& list, const T& example) {
    ++count;
    if (list.size() < MeshReport::k_examples) list.push_back(example);
}

}  // namespace pierce::detail

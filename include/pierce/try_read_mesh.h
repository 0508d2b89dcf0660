// Reading a mesh in a program without exceptions.
#pragma once

#include <filesystem>

#include <pierce/export.h>
#include <pierce/result.h>
#include <pierce/triangle_soup.h>

namespace pierce {

/// As `read_mesh`, but says why there is no mesh: `Status::bad_file`, `out_of_memory`, or `failed`.
template <class Scalar>
[[nodiscard]] PIERCE_EXPORT Result<TriangleSoup<Scalar>> try_read_mesh(const std::filesystem::path& path,
                                                                       const ReadOptions& options = {}) noexcept;

extern template PIERCE_EXPORT Result<TriangleSoup<float>> try_read_mesh<float>(const std::filesystem::path&,
                                                                               const ReadOptions&) noexcept;
extern template PIERCE_EXPORT Result<TriangleSoup<double>> try_read_mesh<double>(const std::filesystem::path&,
                                                                                 const ReadOptions&) noexcept;

}  // namespace pierce

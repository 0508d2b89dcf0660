// Reading a mesh in a program without exceptions.
#pragma once

#include <filesystem>

#include <pierce/result.h>
#include <pierce/triangle_soup.h>

namespace pierce {

/// As `read_mesh`, but says why there is no mesh: `Status::bad_file`, `out_of_memory`, or `failed`.
template <class Scalar>
[[nodiscard]] Result<TriangleSoup<Scalar>> try_read_mesh(const std::filesystem::path& path) noexcept;

extern template Result<TriangleSoup<float>> try_read_mesh<float>(const std::filesystem::path&) noexcept;
extern template Result<TriangleSoup<double>> try_read_mesh<double>(const std::filesystem::path&) noexcept;

}  // namespace pierce

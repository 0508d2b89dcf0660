// An image in memory, and its form as a PNG file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace show {

struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb = {};  ///< three bytes a pixel, rows from the top
};

/// The bytes of a PNG file, 8-bit RGB. Throws std::runtime_error if libpng gives up.
std::string to_png(const Image& image);

/// The same into a file. Throws std::runtime_error, with its name, where it can't be written.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace show

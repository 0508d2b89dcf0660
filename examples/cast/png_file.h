// An image in memory, and its form as a PNG file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

struct Image {
    int width;
    int height;
    std::vector<std::uint8_t> rgb;  ///< three bytes a pixel, rows from the top
};

/// The bytes of a PNG file, 8-bit RGB. Throws InputError if libpng gives up.
std::string to_png(const Image& image);

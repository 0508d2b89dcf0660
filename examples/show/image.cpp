// See image.h.
#include "show/image.h"

#include <fstream>
#include <stdexcept>

#include <png.h>

namespace show {

std::string to_png(const Image& image) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.format = PNG_FORMAT_RGB;
    png.width = static_cast<png_uint_32>(image.width);
    png.height = static_cast<png_uint_32>(image.height);

    // Into memory, not into a file by name: libpng would remove a file that it can't write, whatever that was.
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
    std::string bytes(size, '\0');
    if (!png_image_write_to_memory(&png, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr))
        throw std::runtime_error(std::string("the picture can't be packed: ") + png.message);
    bytes.resize(size);
    return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image) {
    std::ofstream stream(path, std::ios::binary);
    stream << to_png(image);
    stream.close();
    if (!stream) throw std::runtime_error(path.string() + ": can't be written");
}

}  // namespace show

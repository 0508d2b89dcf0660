// The header of a PLY file: which elements follow, and of what numbers each row of them is made.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "mesh/read_source.h"

namespace pierce::detail {

enum class PlyFormat : std::uint8_t { text, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] std::uint64_t bytes_of(PlyType type);

struct PlyProperty {
    std::string_view name;
    PlyType type;                       ///< of the number, or of each item of a list
    std::optional<PlyType> count_type;  ///< of a list's length; none if it is a single number
    const char* place;                  ///< in the header, for messages
};

struct PlyElement {
    std::string_view name;
    std::uint64_t rows;
    std::vector<PlyProperty> properties;
    const char* place;
};

struct PlyHeader {
    PlyFormat format;
    std::vector<PlyElement> elements;
    const char* body;  ///< where the first row starts
};

/// Refuses a header that is malformed or names what is not known. Counts are only read here: see `check_sizes`.
[[nodiscard]] PlyHeader read_ply_header(const SourceFile& file);

/// Refuses counts for which the rest of the file is too short, so that a reader may trust them when it reserves memory
/// or loops. `corners` is the list that holds the corners of faces, at least three to a row, if there is one.
void check_sizes(const PlyHeader& header, const PlyProperty* corners, const SourceFile& file);

}  // namespace pierce::detail

// The first bytes of the usual kinds of packed files.
#include "mesh/read_packed.h"

#include <array>
#include <string>
#include <utility>

namespace pierce::detail {
namespace {

using namespace std::string_view_literals;

// gzip: RFC 1952, section 2.3.1. Zip: APPNOTE 4.3.7 and 4.3.16, for an archive without files. xz: its file format,
// 2.1.1.1. Zstandard: RFC 8878, section 3.1.1. bzip2 has a digit behind these three. 7-Zip: 7zFormat.txt.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> k_kinds = {{
    {"\x1F\x8B"sv, "a gzip file"sv},
    {"PK\3\4"sv, "a zip archive"sv},
    {"PK\5\6"sv, "a zip archive"sv},
    {"\xFD"
     "7zXZ\0"sv,
     "an xz file"sv},
    {"\x28\xB5\x2F\xFD"sv, "a zstd file"sv},
    {"BZh"sv, "a bzip2 file"sv},
    {"7z\xBC\xAF\x27\x1C"sv, "a 7z archive"sv},
}};

}  // namespace

void refuse_packed(const SourceFile& file) {
    for (const auto& [start, kind] : k_kinds) {
        if (std::string_view(file.begin(), file.size()).starts_with(start)) {
            file.fail(std::string("is ").append(kind) + ": unpack it first");
        }
    }
}

}  // namespace pierce::detail

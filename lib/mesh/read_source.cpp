// Loading a file and wording its refusal.
#include "mesh/read_source.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>

#include <pierce/mesh_view.h>

namespace pierce::detail {
namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

std::string printable(std::string_view text) {
    std::string line(text);
    // A message is one line whatever the file, or its name, holds. Bytes above 127 are left: names are often UTF-8.
    const auto is_control = [](unsigned char c) { return c < ' ' || c == 127; };  // char has a sign on some machines
    std::replace_if(line.begin(), line.end(), is_control, '?');
    return line;
}

std::string system_reason(int error) { return std::generic_category().message(error); }

}  // namespace

SourceFile::SourceFile(const std::filesystem::path& path) : path_(path.string()) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) {
        fail("can't be opened: " + error.message());
    }
    if (std::filesystem::is_directory(status)) {
        fail("is a directory");
    }
    // A pipe or a device may have no end, or wait for ever.
    if (!std::filesystem::is_regular_file(status)) {
        fail("is not a regular file");
    }
    const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path_.c_str(), "rb"));
    if (!file) {
        fail("can't be opened: " + system_reason(errno));
    }
    const auto size = std::filesystem::file_size(path, error);
    if (error) {
        fail("can't be read: " + error.message());
    }
    if (size == 0) {
        fail("is empty");
    }
    try {
        bytes_ = std::make_unique_for_overwrite<char[]>(static_cast<std::size_t>(size) + 1);
    } catch (const std::bad_alloc&) {
        fail("does not fit in memory: it has " + std::to_string(size) + " bytes");
    }
    size_ = std::fread(bytes_.get(), 1, static_cast<std::size_t>(size), file.get());
    if (size_ != size) {
        fail(std::ferror(file.get()) != 0 ? "can't be read: " + system_reason(errno)
                                          : "became shorter while it was read");
    }
    bytes_[size_] = '\n';
}

const char* SourceFile::text_begin() const {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    return std::string_view(begin(), size_).starts_with(mark) ? begin() + mark.size() : begin();
}

void SourceFile::fail(std::string_view reason) const { throw MeshError(printable(path_ + ": ").append(reason)); }

void SourceFile::fail_at_line(const char* place, std::string_view reason) const {
    std::size_t line = 1;
    for (const char* at = begin(); at < place; ++at) {
        line += *at == '\n' || (*at == '\r' && at[1] != '\n') ? 1 : 0;
    }
    throw MeshError(printable(path_ + ":").append(std::to_string(line)).append(": ").append(reason));
}

void SourceFile::fail_at_byte(const char* place, std::string_view reason) const {
    fail(("byte " + std::to_string(place - begin()) + ": ").append(reason));
}

std::string quoted(std::string_view word) {
    constexpr std::size_t longest = 40;
    std::string shown(word.substr(0, longest));
    std::replace_if(
        shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return "'" + shown + (word.size() > longest ? "...'" : "'");
}

std::string counted(std::uint64_t count, std::string_view one, std::string_view many) {
    return (std::to_string(count) + " ").append(count == 1 ? one : many);
}

std::string too_few_corners(std::uint64_t corners, std::string_view what) {
    return std::string("the ").append(what) + " has " + counted(corners, "corner", "corners") +
           ": at least 3 are needed";
}

std::string index_out_of_range(std::uint64_t face, std::string_view index, std::uint64_t vertices,
                               std::string_view note) {
    return ("face " + std::to_string(face) + ": vertex index ").append(index.substr(0, 40)) + " is out of range (" +
           counted(vertices, "vertex", "vertices").append(note) + ")";
}

}  // namespace pierce::detail

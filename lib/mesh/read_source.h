// A mesh file held whole in memory, and the one way in which every reader refuses it: a `MeshError` of one line that
// names the file, the place and the reason.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace pierce::detail {

class SourceFile {
  public:
    /// Reads the file into memory. A copy rather than a mapping: a file that another program cuts short while we read
    /// would end a mapped reader with a signal, and the copy is a small part of the time that parsing takes.
    explicit SourceFile(const std::filesystem::path& path);

    [[nodiscard]] const char* begin() const { return bytes_.get(); }
    /// One past the last byte. A line end stands here, so that a scan for one needs no bound.
    [[nodiscard]] const char* end() const { return bytes_.get() + size_; }
    [[nodiscard]] std::size_t size() const { return size_; }
    /// Where the text starts: past the byte order mark that some editors put before UTF-8.
    [[nodiscard]] const char* text_begin() const;

    [[noreturn]] void fail(std::string_view reason) const;
    /// Names the line, counted from 1, that `place` stands on. Lines are counted here and not while reading: the count
    /// is needed only once, and only in a file that is refused.
    [[noreturn]] void fail_at_line(const char* place, std::string_view reason) const;
    /// Names the offset of `place` in the file, counted from 0.
    [[noreturn]] void fail_at_byte(const char* place, std::string_view reason) const;

  private:
    std::string path_;
    std::unique_ptr<char[]> bytes_;
    std::size_t size_ = 0;
};

/// What a word of the file looks like in a message: in quotes, printable, of bounded length.
[[nodiscard]] std::string quoted(std::string_view word);

/// "1 vertex", "2 vertices".
[[nodiscard]] std::string counted(std::uint64_t count, std::string_view one, std::string_view many);

/// The two things that can be wrong with a face, in the same words for every format. `what` has the corners: a face, or
/// a strip of them.
[[nodiscard]] std::string too_few_corners(std::uint64_t corners, std::string_view what = "face");
/// "face 7: vertex index 9 is out of range (3 vertices)". `note` follows the number of vertices: how a file counts them
/// must be said where the index equals their number, because "3 is out of range (3 vertices)" would puzzle.
[[nodiscard]] std::string index_out_of_range(std::uint64_t face, std::string_view index, std::uint64_t vertices,
                                             std::string_view note);

}  // namespace pierce::detail

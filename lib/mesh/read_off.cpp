// OFF text files: plain, and with colours (C), normals (N) or texture coordinates (ST) behind each position.
#include <string>
#include <string_view>
#include <vector>

#include "mesh/read_formats.h"
#include "mesh/read_soup_builder.h"
#include "mesh/read_text.h"

namespace pierce::detail {
namespace {

/// Reads one vertex or face a line, although the format itself would allow a break anywhere: then a line with a number
/// too few or too many is told from its neighbours, and not read as a different mesh.
template <class Scalar>
class OffReader {
  public:
    OffReader(const SourceFile& file, const ReadOptions& options)
        : text_(file, {.hash_comments = true, .hash_behind_digits = true}), soup_(file, options) {}

    TriangleSoup<Scalar> read() {
        keyword();
        const std::uint64_t vertices = count("vertices");
        const std::uint64_t faces = count("faces");
        pass_edge_count();
        if (!text_.at_end_of_line()) {
            text_.fail("the line goes on behind the three counts");
        }
        text_.next_line();
        // "0 0 0" and a line end for a vertex, "3 0 0 0" for a face; the last line end may be missing.
        constexpr std::uint64_t vertex_bytes = 6;
        constexpr std::uint64_t face_bytes = 8;
        const std::uint64_t left = text_.bytes_left() + 1;
        if (vertices > left / vertex_bytes || faces > (left - vertices * vertex_bytes) / face_bytes) {
            text_.fail_at(counts_, counted(vertices, "vertex", "vertices") + " and " + counted(faces, "face", "faces") +
                                       " do not fit in the " + counted(left - 1, "byte", "bytes") + " that are left");
        }
        soup_.reserve(vertices, faces);
        for (std::uint64_t i = 0; i < vertices; ++i) {
            find_line(i, vertices, "vertices");
            vertex();
        }
        for (std::uint64_t i = 0; i < faces; ++i) {
            find_line(i, faces, "faces");
            face();
        }
        return soup_.finish();
    }

  private:
    /// [ST][C][N][4][n]OFF, also with the letters in another order (MeshLab writes NCOFF). The counts follow on the
    /// same line or the next, or even without a blank (ModelNet's files).
    void keyword() {
        text_.find_line();
        const char* first = text_.place();
        std::string_view rest = text_.word_at(first);
        const auto take = [&rest](std::string_view prefix) {
            const bool found = rest.starts_with(prefix);
            rest.remove_prefix(found ? prefix.size() : 0);
            return found;
        };
        bool other_dimension = false;
        for (bool found = true; found;) {
            const bool texture = take("ST");
            const bool normal = take("N");
            const bool colour = take("C");
            const bool dimension = take("4") || take("n");
            extra_numbers_ += (texture ? 2U : 0U) + (normal ? 3U : 0U);
            has_colour_ = has_colour_ || colour;
            other_dimension = other_dimension || dimension;
            found = texture || normal || colour || dimension;
        }
        if (!take("OFF") || !(rest.empty() || (rest[0] >= '0' && rest[0] <= '9') || rest[0] == '#')) {
            text_.fail_at(first, "begins with " + quoted(text_.word_at(first)) + ", not with OFF");
        }
        if (other_dimension) {
            text_.fail_at(first, "only points of 3 numbers are read, not those of " + quoted(text_.word_at(first)));
        }
        is_plain_ = extra_numbers_ == 0 && !has_colour_;
        text_.go_to(rest.data());
        if (text_.at_end_of_line()) {
            text_.next_line();
            text_.find_line();
        } else if (text_.word_at(text_.place()) == "BINARY") {
            text_.fail("binary OFF files are not read");
        }
        counts_ = text_.place();
    }

    std::uint64_t count(const std::string& what) {
        if (text_.at_end_of_line()) {
            text_.next_line();
            if (!text_.find_line()) {
                text_.fail("the number of " + what + " is missing");
            }
        }
        return not_negative("a number of " + what);
    }

    /// It is often wrong, of no use, and may be missing. A line with a single number is no vertex, so it is this one.
    void pass_edge_count() {
        if (text_.at_end_of_line()) {
            const char* counts_end = text_.place();
            text_.next_line();
            text_.find_line();
            const char* next = text_.place();
            text_.word();
            const bool is_alone = text_.place() != next && text_.at_end_of_line();
            text_.go_to(is_alone ? next : counts_end);
        }
        if (!text_.at_end_of_line()) {
            text_.integer("a number of edges");
        }
    }

    std::uint64_t not_negative(const std::string& what) {
        const char* first = text_.place();
        const std::int64_t number = text_.integer(what);
        if (number < 0) {
            text_.refuse_word(first, what);
        }
        return static_cast<std::uint64_t>(number);
    }

    void find_line(std::uint64_t found, std::uint64_t all, std::string_view what) {
        if (!text_.find_line()) {
            text_.fail("the file ends after " + std::to_string(found) + " of " +
                       std::to_string(all).append(" ").append(what));
        }
    }

    /// What stands behind the position is what the keyword says. Behind a plain OFF many programs write a colour all
    /// the same: whether one does is seen at the first vertex, and holds for all.
    void vertex() {
        const VertexLine<Scalar> line = read_vertex_line<Scalar>(text_);
        const bool tells_colour = is_plain_ && soup_.vertex_count() == 0;
        if (tells_colour && (line.numbers == 6 || line.numbers == 7)) {
            extra_numbers_ = line.numbers - 3;
        }
        const std::size_t least = 3 + extra_numbers_ + (has_colour_ ? 3 : 0);
        if (line.numbers != least && !(has_colour_ && line.numbers == least + 1)) {
            const std::string expected = tells_colour  ? "3, 6 or 7"
                                         : has_colour_ ? std::to_string(least) + " or " + std::to_string(least + 1)
                                                       : std::to_string(least);
            text_.fail("the vertex has " + counted(line.numbers, "number", "numbers") + ": " + expected +
                       " are expected" + (is_plain_ && !tells_colour ? ", as the first one has" : ""));
        }
        soup_.add_vertex(line.position);
        text_.next_line();
    }

    void face() {
        const std::uint64_t corners = not_negative("a number of corners");
        if (corners < 3) {
            text_.fail(too_few_corners(corners));
        }
        corners_.clear();
        while (corners_.size() < corners) {
            if (text_.at_end_of_line()) {
                text_.fail("the line has " + std::to_string(corners_.size()) + " of the face's " +
                           std::to_string(corners) + " corners");
            }
            corners_.push_back(corner());
        }
        soup_.add_face(corners_);
        std::size_t colour = 0;
        for (; !text_.at_end_of_line(); ++colour) {
            text_.pass_number();
        }
        if (colour > 4) {
            text_.fail("the line has " + std::to_string(colour) + " numbers behind the face: a colour has at most 4");
        }
        text_.next_line();
    }

    std::uint32_t corner() {
        const char* first = text_.place();
        const std::int64_t index = text_.integer("a corner");
        if (index < 0 || static_cast<std::uint64_t>(index) >= soup_.vertex_count()) {
            text_.fail_at(first, index_out_of_range(soup_.face_count(), text_.integer_at(first), soup_.vertex_count(),
                                                    ", counted from 0"));
        }
        return static_cast<std::uint32_t>(index);
    }

    TextCursor text_;
    SoupBuilder<Scalar> soup_;
    std::vector<std::uint32_t> corners_;
    const char* counts_ = nullptr;  // where the counts stand
    std::size_t extra_numbers_ = 0;
    bool has_colour_ = false;
    bool is_plain_ = false;  // the keyword names nothing behind the position
};

}  // namespace

template <class Scalar>
TriangleSoup<Scalar> read_off(const SourceFile& file, const ReadOptions& options) {
    return OffReader<Scalar>(file, options).read();
}

template TriangleSoup<float> read_off<float>(const SourceFile&, const ReadOptions&);
template TriangleSoup<double> read_off<double>(const SourceFile&, const ReadOptions&);

}  // namespace pierce::detail

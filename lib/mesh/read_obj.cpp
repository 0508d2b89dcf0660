// Wavefront OBJ: `v` and `f` are read; statements that hold no surface are passed over; all others are refused.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/read_formats.h"
#include "mesh/read_soup_builder.h"
#include "mesh/read_text.h"

namespace pierce::detail {
namespace {

using namespace std::string_view_literals;

// Texture coordinates, normals, points, lines and settings in numbers.
constexpr std::array k_number_statements = {"vt"sv, "vn"sv, "vp"sv, "l"sv, "p"sv, "s"sv, "mg"sv, "lod"sv};
constexpr std::array k_name_statements = {"mtllib"sv,   "usemap"sv,   "maplib"sv,     "bevel"sv,
                                          "c_interp"sv, "d_interp"sv, "shadow_obj"sv, "trace_obj"sv};
constexpr std::array k_free_form_statements = {"cstype"sv, "deg"sv,   "bmat"sv, "step"sv, "curv"sv, "curv2"sv, "surf"sv,
                                               "parm"sv,   "trim"sv,  "hole"sv, "scrv"sv, "sp"sv,   "end"sv,   "con"sv,
                                               "ctech"sv,  "stech"sv, "bsp"sv,  "bzp"sv,  "cdc"sv,  "cdp"sv,   "res"sv};

template <class Words>
bool holds(const Words& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

template <class Scalar>
class ObjReader {
  public:
    ObjReader(const SourceFile& file, const ReadOptions& options)
        : text_(file, {.hash_comments = true, .continued_lines = true}), soup_(file, options) {}

    TriangleSoup<Scalar> read() {
        for (; text_.find_line(); text_.next_line()) {
            const char* first = text_.place();
            const std::string_view keyword = text_.word();
            if (keyword == "v") {
                vertex();
            } else if (keyword == "f") {
                face();
            } else if (keyword == "usemtl") {
                soup_.set_material(names());
            } else if (keyword == "g" || keyword == "o") {
                soup_.set_group(names());
            } else {
                other(first, keyword);
            }
        }
        check_forward_corners();
        return soup_.finish();
    }

  private:
    /// x y z, then a weight, a colour, or both. The weight has a meaning for free-form surfaces only.
    void vertex() {
        const VertexLine<Scalar> line = read_vertex_line<Scalar>(text_);
        if (line.numbers < 3 || line.numbers == 5) {
            text_.fail("the vertex has " + counted(line.numbers, "number", "numbers") +
                       ": 3, 4, or 6 and more are expected");
        }
        soup_.add_vertex(line.position);
    }

    void face() {
        corners_.clear();
        while (!text_.at_end_of_line()) {
            corners_.push_back(corner());
        }
        if (corners_.size() < 3) {
            text_.fail(too_few_corners(corners_.size()));
        }
        soup_.add_face(corners_);
    }

    /// One of v, v/vt, v//vn, v/vt/vn.
    std::uint32_t corner() {
        constexpr std::string_view what = "a corner";
        const char* first = text_.place();
        const std::int64_t index = text_.leading_integer(what);
        for (int part = 0; part < 2 && text_.accept('/'); ++part) {
            if (!text_.ends_word() && !text_.next_is('/')) {
                static_cast<void>(text_.leading_integer(what));
            }
        }
        if (!text_.ends_word()) {
            text_.refuse_word(first, what);
        }
        return vertex_of(index, first);
    }

    std::uint32_t vertex_of(std::int64_t index, const char* first) {
        const auto vertices = static_cast<std::int64_t>(soup_.vertex_count());
        if (index == 0) {
            text_.fail_at(first, "face " + std::to_string(soup_.face_count()) +
                                     ": vertex index 0 is out of range (vertices are counted from 1)");
        }
        if (index < 0) {
            if (-index > vertices) {
                refuse_backward(first);
            }
            return static_cast<std::uint32_t>(vertices + index);
        }
        if (index > vertices && (forward_.empty() || index > forward_.back().index)) {
            forward_.push_back({index, first, soup_.face_count()});
        }
        return static_cast<std::uint32_t>(index - 1);
    }

    [[noreturn]] void refuse_backward(const char* first) {
        const std::uint64_t vertices = soup_.vertex_count();
        text_.fail_at(first, index_out_of_range(soup_.face_count(), text_.integer_at(first), vertices, " before it"));
    }

    /// A face may use vertices that come after it. Kept are only the corners that are further ahead than all before
    /// them: the first corner beyond any number of vertices is one of these.
    void check_forward_corners() {
        const auto vertices = static_cast<std::int64_t>(soup_.vertex_count());
        for (const ForwardCorner& corner : forward_) {
            if (corner.index > vertices) {
                text_.fail_at(corner.place, index_out_of_range(corner.face, text_.integer_at(corner.place),
                                                               soup_.vertex_count(), ""));
            }
        }
    }

    void other(const char* first, std::string_view keyword) {
        if (keyword[0] == '$') {  // a comment in Viewpoint's files
            return;
        }
        if (holds(k_number_statements, keyword)) {
            pass_numbers();
        } else if (holds(k_name_statements, keyword)) {
            names();
        } else if (holds(k_free_form_statements, keyword)) {
            text_.fail_at(first, "free-form curves and surfaces are not read: " + quoted(keyword));
        } else {
            text_.fail_at(first, "unknown statement " + quoted(keyword));
        }
    }

    void pass_numbers() {
        while (!text_.at_end_of_line()) {
            text_.word();
        }
    }

    /// All that stands behind the keyword, byte for byte, with a blank where the line is continued. A backslash right
    /// behind a name, as in `mtllib C:\meshes\`, belongs to it; the statement on the next line must not be lost. After
    /// a blank it continues the line, as everywhere.
    std::string_view names() {
        names_.clear();
        const char* end = text_.place();
        while (!text_.at_end_of_line()) {
            const std::string_view between(end, static_cast<std::size_t>(text_.place() - end));
            if (!names_.empty()) {
                names_ += between.find('\\') == std::string_view::npos ? between : " ";
            }
            names_ += text_.word();
            end = text_.place();
            if (text_.next_is('\\')) {
                names_ += '\\';
                break;
            }
        }
        return names_;
    }

    struct ForwardCorner {
        std::int64_t index;
        const char* place;
        std::uint64_t face;
    };

    TextCursor text_;
    SoupBuilder<Scalar> soup_;
    std::vector<std::uint32_t> corners_;
    std::vector<ForwardCorner> forward_;
    std::string names_;
};

}  // namespace

template <class Scalar>
TriangleSoup<Scalar> read_obj(const SourceFile& file, const ReadOptions& options) {
    return ObjReader<Scalar>(file, options).read();
}

template TriangleSoup<float> read_obj<float>(const SourceFile&, const ReadOptions&);
template TriangleSoup<double> read_obj<double>(const SourceFile&, const ReadOptions&);

}  // namespace pierce::detail

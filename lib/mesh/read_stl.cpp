// STL, text and binary. It has no vertices, only corners: those at equal coordinates become one vertex.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/read_bytes.h"
#include "mesh/read_formats.h"
#include "mesh/read_packed.h"
#include "mesh/read_soup_builder.h"
#include "mesh/read_text.h"
#include "mesh/read_vertex_merger.h"

namespace pierce::detail {
namespace {

constexpr std::string_view k_end = "end";
constexpr std::size_t k_header_bytes = 80;
constexpr std::size_t k_start_bytes = k_header_bytes + 4;  // with the count of facets
constexpr std::size_t k_facet_bytes = 50;  // normal, three corners of three floats, 16 bits for free use

bool equals_ignoring_case(std::string_view word, std::string_view lower) {
    return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                      [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

std::uint64_t binary_size(const SourceFile& file) {
    const auto facets = number_at<std::uint32_t>(file.begin() + k_header_bytes, std::endian::little);
    return k_start_bytes + std::uint64_t{facets} * k_facet_bytes;
}

/// Binary files may begin with "solid" too. The size tells: read as a count, four characters of a text mean a file of
/// many gigabytes. Where the size fits neither way, a zero byte tells, so that the message is about the right kind of
/// file.
bool is_text(const SourceFile& file) {
    const std::string_view start(file.begin(), std::min(file.size(), k_start_bytes));
    if (start.size() == k_start_bytes && binary_size(file) == file.size()) {
        return false;
    }
    TextCursor text(file, {});
    text.find_line();
    return equals_ignoring_case(text.word(), "solid") && start.find('\0') == std::string_view::npos;
}

template <class Scalar>
class StlReader {
  public:
    StlReader(const SourceFile& file, const ReadOptions& options)
        : file_(file), text_(file, {}), soup_(file, options), merger_(soup_) {}

    TriangleSoup<Scalar> read_text() {
        while (text_.find_line()) {
            expect("solid");
            soup_.set_group(text_.rest_of_line());
            while (next_word_is("facet", "endsolid")) {
                facet();
            }
            text_.next_line();
        }
        return soup_.finish();
    }

    TriangleSoup<Scalar> read_binary() {
        if (file_.size() < k_start_bytes || binary_size(file_) != file_.size()) {
            refuse_packed(file_);
        }
        if (file_.size() < k_start_bytes) {
            file_.fail_at_byte(file_.end(),
                               "the file ends inside the first " + std::to_string(k_start_bytes) + " bytes");
        }
        if (binary_size(file_) != file_.size()) {
            const auto facets = number_at<std::uint32_t>(file_.begin() + k_header_bytes, std::endian::little);
            file_.fail_at_byte(file_.begin() + k_header_bytes,
                               counted(facets, "triangle", "triangles") + " make a file of " +
                                   std::to_string(binary_size(file_)) + " bytes: this one has " +
                                   std::to_string(file_.size()));
        }
        soup_.reserve(0, (file_.size() - k_start_bytes) / k_facet_bytes);
        for (const char* facet = file_.begin() + k_start_bytes; facet != file_.end(); facet += k_facet_bytes) {
            const char* at = facet + 12;  // behind the normal
            corners_.clear();
            for (int corner = 0; corner < 3; ++corner) {
                Vec3<Scalar> position;
                for (Scalar& x : position) {
                    x = coordinate_from<Scalar>(number_at<float>(at, std::endian::little), file_, at);
                    at += 4;
                }
                corners_.push_back(merger_.vertex_at(position));
            }
            soup_.add_face(corners_);
        }
        return soup_.finish();
    }

  private:
    /// normal x y z / outer loop / three times vertex x y z / endloop / endfacet. The normal follows from the corners,
    /// and is often wrong: it is passed over.
    void facet() {
        expect("normal");
        for (int i = 0; i < 3; ++i) {
            find_number();
            text_.word();
        }
        expect("outer");
        expect("loop");
        corners_.clear();
        while (next_word_is("vertex", "endloop")) {
            Vec3<Scalar> position;
            for (Scalar& x : position) {
                find_number();
                x = text_.coordinate<Scalar>();
            }
            corners_.push_back(merger_.vertex_at(position));
        }
        if (corners_.size() < 3) {
            text_.fail(too_few_corners(corners_.size()));
        }
        soup_.add_face(corners_);
        expect("endfacet");
    }

    void find_number() {
        if (!text_.find_line()) {
            text_.fail("the file ends where a number is expected");
        }
    }

    /// True for the first of two words, false for the second; all others are refused. What ends a part is one word,
    /// or two: `end loop`.
    bool next_word_is(std::string_view one, std::string_view other) {
        if (!text_.find_line()) {
            text_.fail("the file ends where " + either(one, other) + " is expected");
        }
        const char* first = text_.place();
        const std::string_view found = text_.word();
        const bool is_half = equals_ignoring_case(found, k_end);
        const std::string_view half = is_half ? text_.word() : std::string_view();
        const auto is = [&](std::string_view word) {
            return is_half ? word.starts_with(k_end) && equals_ignoring_case(half, word.substr(k_end.size()))
                           : equals_ignoring_case(found, word);
        };
        if (is(one)) {
            return true;
        }
        if (!is(other)) {
            text_.refuse_word(first, either(one, other));
        }
        return false;
    }
    void expect(std::string_view word) { static_cast<void>(next_word_is(word, {})); }

    static std::string either(std::string_view one, std::string_view other) {
        return other.empty() ? quoted(one) : quoted(one) + " or " + quoted(other);
    }

    const SourceFile& file_;
    TextCursor text_;
    SoupBuilder<Scalar> soup_;
    VertexMerger<Scalar> merger_;
    std::vector<std::uint32_t> corners_;
};

}  // namespace

template <class Scalar>
TriangleSoup<Scalar> read_stl(const SourceFile& file, const ReadOptions& options) {
    StlReader<Scalar> reader(file, options);
    return is_text(file) ? reader.read_text() : reader.read_binary();
}

template TriangleSoup<float> read_stl<float>(const SourceFile&, const ReadOptions&);
template TriangleSoup<double> read_stl<double>(const SourceFile&, const ReadOptions&);

}  // namespace pierce::detail

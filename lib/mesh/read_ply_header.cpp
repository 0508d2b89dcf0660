// Parses the header of a PLY file. (Turk 1994, "The PLY Polygon File Format")
#include "mesh/read_ply_header.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "mesh/read_text.h"

namespace pierce::detail {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> k_types = {{
    {"char", PlyType::int8},
    {"int8", PlyType::int8},
    {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},
    {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},
    {"uint16", PlyType::uint16},
    {"int", PlyType::int32},
    {"int32", PlyType::int32},
    {"uint", PlyType::uint32},
    {"uint32", PlyType::uint32},
    {"float", PlyType::float32},
    {"float32", PlyType::float32},
    {"double", PlyType::float64},
    {"float64", PlyType::float64},
}};

constexpr std::array<std::pair<std::string_view, PlyFormat>, 3> k_formats = {{
    {"ascii", PlyFormat::text},
    {"binary_little_endian", PlyFormat::little_endian},
    {"binary_big_endian", PlyFormat::big_endian},
}};

class PlyHeaderReader {
  public:
    explicit PlyHeaderReader(const SourceFile& file) : file_(file), text_(file, {}) {}

    PlyHeader read() {
        const char* first = text_.place();
        if (const std::string_view magic = text_.word(); magic != "ply") {
            text_.fail_at(first, "begins with " + quoted(magic) + ", not with 'ply'");
        }
        end_line();
        while (true) {
            if (!text_.find_line()) {
                text_.fail("the file ends inside the header: there is no end_header");
            }
            first = text_.place();
            const std::string_view keyword = text_.word();
            if (keyword == "end_header") {
                break;
            }
            statement(first, keyword);
        }
        if (!has_format_) {
            text_.fail_at(first, "the header names no format");
        }
        find_body();
        return std::move(header_);
    }

  private:
    void statement(const char* first, std::string_view keyword) {
        if (keyword == "comment" || keyword == "obj_info") {
            text_.next_line();
        } else if (keyword == "format") {
            format();
        } else if (keyword == "element") {
            element(first);
        } else if (keyword == "property") {
            property(first);
        } else {
            text_.fail_at(first, "unknown header line " + quoted(keyword));
        }
    }

    void format() {
        header_.format = named(k_formats, "format");
        if (const std::string_view version = needed_word("version"); version != "1.0") {
            text_.fail("version " + quoted(version) + " is not known: only 1.0 is");
        }
        has_format_ = true;
        end_line();
    }

    void element(const char* first) {
        const std::string_view name = needed_word("name");
        if (std::any_of(header_.elements.begin(), header_.elements.end(),
                        [=](const auto& e) { return e.name == name; })) {
            text_.fail_at(first, "element " + quoted(name) + " comes twice");
        }
        text_.at_end_of_line();
        const char* count = text_.place();
        const std::int64_t rows = text_.integer("a count");
        if (rows < 0) {
            text_.refuse_word(count, "a count");
        }
        header_.elements.push_back({name, static_cast<std::uint64_t>(rows), {}, first});
        end_line();
    }

    void property(const char* first) {
        if (header_.elements.empty()) {
            text_.fail_at(first, "a property stands before the first element");
        }
        PlyProperty property{{}, {}, {}, first};
        text_.at_end_of_line();
        if (text_.word_at(text_.place()) == "list") {
            text_.word();
            property.count_type = named(k_types, "type");
            if (*property.count_type >= PlyType::float32) {
                text_.fail_at(first, "the length of a list can't be a floating-point number");
            }
        }
        property.type = named(k_types, "type");
        property.name = needed_word("name");
        auto& properties = header_.elements.back().properties;
        if (std::any_of(properties.begin(), properties.end(), [&](const auto& p) { return p.name == property.name; })) {
            text_.fail_at(first, "property " + quoted(property.name) + " comes twice");
        }
        properties.push_back(property);
        end_line();
    }

    /// The value that the next word stands for in a table.
    template <class Value, std::size_t Size>
    Value named(const std::array<std::pair<std::string_view, Value>, Size>& table, std::string_view what) {
        const std::string_view word = needed_word(what);
        const auto found =
            std::find_if(table.begin(), table.end(), [=](const auto& entry) { return entry.first == word; });
        if (found == table.end()) {
            text_.fail(std::string(what) + " " + quoted(word) + " is not known");
        }
        return found->second;
    }

    std::string_view needed_word(std::string_view what) {
        const std::string_view word = text_.word();
        if (word.empty()) {
            text_.fail("the line ends where a " + std::string(what) + " is expected");
        }
        return word;
    }

    void end_line() {
        if (!text_.at_end_of_line()) {
            text_.fail("the line goes on with " + quoted(text_.word_at(text_.place())));
        }
        text_.next_line();
    }

    /// The body starts right behind the line end. If that is a lone \r, a \n behind it is the first byte of the body:
    /// such files end all their lines so.
    void find_body() {
        if (!text_.at_end_of_line()) {
            end_line();
        }
        const std::string_view text(file_.begin(), file_.size());
        const std::size_t line_end = text.find_first_of("\r\n");
        const bool lone_returns = text.substr(line_end, 1) == "\r" && text.substr(line_end + 1, 1) != "\n";
        if (lone_returns && text_.next_is('\r')) {
            header_.body = text_.place() + 1;
        } else {
            text_.next_line();
            header_.body = text_.place();
        }
    }

    const SourceFile& file_;
    TextCursor text_;
    PlyHeader header_{};
    bool has_format_ = false;
};

/// The bytes that a row takes at least; in text, a digit and a blank or line end for each number.
std::uint64_t least_bytes(const PlyElement& element, const PlyHeader& header, const PlyProperty* corners) {
    const auto least = [&](PlyType type) { return header.format == PlyFormat::text ? 2 : bytes_of(type); };
    std::uint64_t bytes = 0;
    for (const PlyProperty& property : element.properties) {
        bytes += least(property.count_type.value_or(property.type));
        bytes += &property == corners ? 3 * least(property.type) : 0;
    }
    return bytes;
}

}  // namespace

std::uint64_t bytes_of(PlyType type) {
    constexpr std::array<std::uint64_t, 8> bytes = {1, 1, 2, 2, 4, 4, 4, 8};
    return bytes[static_cast<std::size_t>(type)];
}

PlyHeader read_ply_header(const SourceFile& file) { return PlyHeaderReader(file).read(); }

void check_sizes(const PlyHeader& header, const PlyProperty* corners, const SourceFile& file) {
    auto left = static_cast<std::uint64_t>(file.end() - header.body);
    left += header.format == PlyFormat::text ? 1 : 0;  // the last line end may be missing
    for (const PlyElement& element : header.elements) {
        const std::uint64_t row = least_bytes(element, header, corners);
        if (row == 0) {
            continue;
        }
        if (element.rows > left / row) {
            file.fail_at_line(element.place, counted(element.rows, "row", "rows") + " of element " +
                                                 quoted(element.name) + ", of at least " +
                                                 counted(row, "byte", "bytes") + " each, do not fit in the " +
                                                 std::to_string(left) + " that are left");
        }
        left -= element.rows * row;
    }
}

}  // namespace pierce::detail

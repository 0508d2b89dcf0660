// The rows of a PLY file as a stream of numbers, from text or from bytes, for one reader that need not know which.
#pragma once

#include <bit>
#include <cstdint>
#include <string>

#include "mesh/read_bytes.h"
#include "mesh/read_ply_header.h"
#include "mesh/read_text.h"

namespace pierce::detail {

/// Rows are lines here: then a line with a number too few or too many is told from its neighbours.
class PlyTextBody {
  public:
    PlyTextBody(const PlyHeader& header, const SourceFile& file) : text_(file, {}) { text_.go_to(header.body); }

    void begin_row(const PlyElement& element, std::uint64_t row) {
        if (!text_.find_line()) {
            text_.fail("the file ends after " + std::to_string(row) + " of " + counted(element.rows, "row", "rows") +
                       " of element " + quoted(element.name));
        }
    }
    void end_row() {
        if (!text_.at_end_of_line()) {
            text_.fail("the line goes on behind its last property");
        }
        text_.next_line();
    }

    template <class Scalar>
    Scalar coordinate(PlyType) {
        find_number();
        return text_.coordinate<Scalar>();
    }
    std::int64_t integer(PlyType) {
        find_number();
        const char* first = text_.place();
        const std::int64_t value = text_.integer("an integer");
        if (value > 0xFFFF'FFFF || value < -0x8000'0000LL) {
            text_.refuse_word(first, "an integer of at most 32 bits");
        }
        return value;
    }
    void pass(PlyType, std::uint64_t numbers) {
        for (std::uint64_t i = 0; i < numbers; ++i) {
            find_number();
            text_.pass_number();
        }
    }

    /// Where the next number stands.
    const char* place() {
        text_.at_end_of_line();
        return text_.place();
    }
    [[noreturn]] void fail_at(const char* place, std::string_view reason) const { text_.fail_at(place, reason); }

  private:
    void find_number() {
        if (text_.at_end_of_line()) {
            text_.fail("the line ends before its last property");
        }
    }

    TextCursor text_;
};

class PlyBinaryBody {
  public:
    PlyBinaryBody(const PlyHeader& header, const SourceFile& file)
        : file_(file),
          at_(header.body),
          order_(header.format == PlyFormat::big_endian ? std::endian::big : std::endian::little) {}

    void begin_row(const PlyElement& element, std::uint64_t row) {
        element_ = &element;
        row_ = row;
    }
    void end_row() {}

    template <class Scalar>
    Scalar coordinate(PlyType type) {
        const char* first = place();
        return with_number<Scalar>(type, [&](auto number) { return coordinate_from<Scalar>(number, file_, first); });
    }
    std::int64_t integer(PlyType type) {
        return with_number<std::int64_t>(type, [](auto number) { return static_cast<std::int64_t>(number); });
    }
    void pass(PlyType type, std::uint64_t numbers) {
        const std::uint64_t bytes = numbers * bytes_of(type);  // of 2^32 numbers at most
        need(bytes);
        at_ += bytes;
    }

    [[nodiscard]] const char* place() const { return at_; }
    [[noreturn]] void fail_at(const char* place, std::string_view reason) const { file_.fail_at_byte(place, reason); }

  private:
    void need(std::uint64_t bytes) const {
        if (bytes > static_cast<std::uint64_t>(file_.end() - at_)) {
            file_.fail_at_byte(file_.end(), "the file ends inside row " + std::to_string(row_) + " of the " +
                                                std::to_string(element_->rows) + " of element " +
                                                quoted(element_->name) + ", counted from 0");
        }
    }

    template <class Number>
    Number take() {
        need(sizeof(Number));
        const char* first = at_;
        at_ += sizeof(Number);
        return number_at<Number>(first, order_);
    }

    /// Calls `use` with the next number, of whatever type it is.
    template <class Result, class Use>
    Result with_number(PlyType type, Use use) {
        switch (type) {
            case PlyType::int8:
                return use(take<std::int8_t>());
            case PlyType::uint8:
                return use(take<std::uint8_t>());
            case PlyType::int16:
                return use(take<std::int16_t>());
            case PlyType::uint16:
                return use(take<std::uint16_t>());
            case PlyType::int32:
                return use(take<std::int32_t>());
            case PlyType::uint32:
                return use(take<std::uint32_t>());
            case PlyType::float32:
                return use(take<float>());
            case PlyType::float64:
                break;
        }
        return use(take<double>());
    }

    const SourceFile& file_;
    const char* at_;
    std::endian order_;
    const PlyElement* element_ = nullptr;
    std::uint64_t row_ = 0;
};

}  // namespace pierce::detail

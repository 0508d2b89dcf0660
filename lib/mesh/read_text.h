// The tokeniser of every text format: walks over blanks, words, numbers and line ends of a file in memory, and refuses
// what is not a number, or not a finite one, naming its line.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

#include <fast_float/fast_float.h>

#include <pierce/types.h>

#include "mesh/read_source.h"

namespace pierce::detail {

/// What differs between the text formats below the level of words.
struct TextRules {
    bool hash_comments = false;       ///< a word that begins with '#' ends the line
    bool hash_behind_digits = false;  ///< and so does a '#' right behind the last digit of a number
    bool continued_lines = false;     ///< a backslash before a line end joins the next line on
};

class TextCursor {
  public:
    TextCursor(const SourceFile& file, TextRules rules)
        : file_(file), rules_(rules), at_(file.text_begin()), end_(file.end()) {}

    [[nodiscard]] const char* place() const { return at_; }
    [[nodiscard]] bool at_end_of_file() const { return at_ == end_; }
    [[nodiscard]] std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }

    /// Passes over blanks; true when no word is left on the line. Line ends are \n, \r\n and \r.
    bool at_end_of_line() {
        while (true) {
            while (*at_ == ' ' || *at_ == '\t') {
                ++at_;
            }
            if (!joins_lines(at_)) {
                return is_line_end(*at_) || (*at_ == '#' && rules_.hash_comments);
            }
            at_ = after_line_end(at_ + 1);
        }
    }

    /// Passes over what is left of this line, unread.
    void next_line() {
        while (!is_line_end(*at_)) {
            ++at_;
        }
        at_ = after_line_end(at_);
    }

    /// Passes over blank lines and comments; false when the file has ended.
    bool find_line() {
        while (at_end_of_line() && !at_end_of_file()) {
            next_line();
        }
        return !at_end_of_file();
    }

    /// The word that starts here and runs to a blank or line end. Empty at the end of a line.
    std::string_view word() {
        const std::string_view found = at_end_of_line() ? std::string_view() : word_at(at_);
        at_ += found.size();
        return found;
    }

    /// What is left of this line, less the blanks around it. It may hold what would begin a comment elsewhere.
    std::string_view rest_of_line() {
        at_end_of_line();
        const char* first = at_;
        const char* last = at_;
        for (; !is_line_end(*at_); ++at_) {
            last = *at_ == ' ' || *at_ == '\t' ? last : at_ + 1;
        }
        return {first, static_cast<std::size_t>(last - first)};
    }

    /// A finite number, correctly rounded from its decimals in a single step.
    template <class Scalar>
    Scalar coordinate() {
        Scalar value;
        const char* first = at_;
        at_ = parse(value);
        if (!std::isfinite(value)) {
            refuse_infinite(first, std::is_same_v<Scalar, float> ? "float" : "double");
        }
        return value;
    }

    /// Passes over a number that is not geometry: a colour or a normal, which may be anything but must be a number.
    void pass_number() {
        double value;
        at_ = parse(value);
    }

    /// An integer that may go on behind its digits, as in `7/1/3`. Larger ones than any count can be are returned as
    /// `huge`, or minus that, so that nothing overflows. `what` says in a message what was expected here.
    std::int64_t leading_integer(std::string_view what) {
        const char* first = at_;
        at_ += *first == '-' || *first == '+' ? 1 : 0;
        const char* digits = at_;
        std::int64_t size = 0;
        for (; is_digit(*at_); ++at_) {
            size = size < huge / 10 ? 10 * size + (*at_ - '0') : huge;
        }
        if (at_ == digits) {
            refuse_word(first, what);
        }
        return *first == '-' ? -size : size;
    }
    std::int64_t integer(std::string_view what) {
        const char* first = at_;
        const std::int64_t value = leading_integer(what);
        if (!ends_number(at_)) {
            refuse_word(first, what);
        }
        return value;
    }
    static constexpr std::int64_t huge = 1'000'000'000'000'000'000;

    void go_to(const char* place) { at_ = place; }
    /// True, and passes over it, if `c` is the next character.
    bool accept(char c) {
        const bool found = *at_ == c && at_ != end_;
        at_ += found ? 1 : 0;
        return found;
    }
    [[nodiscard]] bool next_is(char c) const { return *at_ == c; }
    [[nodiscard]] bool ends_word() const { return ends_word(at_); }

    /// The whole word, or only the integer, that starts at a place passed before; for messages.
    [[nodiscard]] std::string_view word_at(const char* first) const;
    [[nodiscard]] std::string_view integer_at(const char* first) const;

    [[noreturn]] void fail(std::string_view reason) const { file_.fail_at_line(at_, reason); }
    [[noreturn]] void fail_at(const char* place, std::string_view reason) const { file_.fail_at_line(place, reason); }
    /// "'abc' is not a number", with "a number" for `what`.
    [[noreturn]] void refuse_word(const char* first, std::string_view what) const;

  private:
    static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
    bool joins_lines(const char* at) const { return *at == '\\' && rules_.continued_lines && is_line_end(at[1]); }
    // A '#' ends no word: "1.#INF", which some programs write, must not be read as 1 and a comment.
    bool ends_word(const char* at) const { return *at == ' ' || *at == '\t' || is_line_end(*at) || joins_lines(at); }
    // `at` is behind at least one character of the number. "1.#INF" is none, here as everywhere.
    bool ends_number(const char* at) const {
        return ends_word(at) || (*at == '#' && rules_.hash_behind_digits && is_digit(at[-1]));
    }
    static bool is_digit(char c) { return c >= '0' && c <= '9'; }
    const char* after_line_end(const char* at) const {
        at += *at == '\r' && at != end_ && at[1] == '\n' ? 1 : 0;
        return at < end_ ? at + 1 : end_;
    }

    template <class Scalar>
    const char* parse(Scalar& value) {
        // A plus sign is common in files, but not known to from_chars, which would also pass over blanks behind it.
        const char* first = at_ + (*at_ == '+' ? 1 : 0);
        const bool one_sign = first == at_ || (*first != '-' && *first > ' ');
        const auto [after, error] = fast_float::from_chars(first, end_, value);
        if (error == std::errc::invalid_argument || !one_sign || !ends_number(after)) {
            refuse_word(at_, "a number");
        }
        return after;
    }
    [[noreturn]] void refuse_infinite(const char* first, std::string_view scalar) const;

    const SourceFile& file_;
    TextRules rules_;
    const char* at_;
    const char* end_;
};

/// The numbers of a vertex line up to its end: the first three are the position, and what follows only counts.
template <class Scalar>
struct VertexLine {
    Vec3<Scalar> position = Vec3<Scalar>::Zero();
    std::size_t numbers = 0;
};

template <class Scalar>
VertexLine<Scalar> read_vertex_line(TextCursor& text) {
    VertexLine<Scalar> line;
    while (!text.at_end_of_line()) {
        if (line.numbers < 3) {
            line.position[static_cast<Eigen::Index>(line.numbers)] = text.coordinate<Scalar>();
        } else {
            text.pass_number();
        }
        ++line.numbers;
    }
    return line;
}

}  // namespace pierce::detail

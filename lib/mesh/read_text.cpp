// The parts of the tokeniser that run only when a file is refused.
#include "mesh/read_text.h"

#include <string>

namespace pierce::detail {

std::string_view TextCursor::word_at(const char* first) const {
    const char* last = first;
    while (!ends_word(last)) {
        ++last;
    }
    return {first, static_cast<std::size_t>(last - first)};
}

std::string_view TextCursor::integer_at(const char* first) const {
    const std::string_view word = word_at(first);
    const std::size_t after = word.find_first_not_of("0123456789", 1);
    return word.substr(0, after);
}

void TextCursor::refuse_word(const char* first, std::string_view what) const {
    fail_at(first, (quoted(word_at(first)) + " is not ").append(what));
}

void TextCursor::refuse_infinite(const char* first, std::string_view scalar) const {
    const std::string_view word = word_at(first);
    // Only a number that is spelled in digits can have been too large.
    const bool too_large = word.find_first_of("0123456789") == word.find_first_not_of("+-.");
    const std::string coordinate = "coordinate " + quoted(word);
    fail_at(first, too_large ? (coordinate + " does not fit in ").append(scalar) : coordinate + " is not finite");
}

}  // namespace pierce::detail

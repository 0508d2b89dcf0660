// See numbers.h.
#include "cast/numbers.h"

#include <array>

namespace {

template <class... Format>
std::string to_text(Format... format) {
    std::array<char, 64> text;
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), format...);
    return {text.data(), end};
}

}  // namespace

std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string result = "'";
    for (const char c : text.substr(0, longest)) result += c >= ' ' && c <= '~' ? c : '?';
    return result + (text.size() > longest ? "...'" : "'");
}

std::string shortest(float number) { return to_text(number); }
std::string shortest(double number) { return to_text(number); }

std::string rounded(double number, int digits) { return to_text(number, std::chars_format::general, digits); }

std::string grouped(std::uint64_t number) {
    const std::string digits = std::to_string(number);
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
        text += digits[i];
    }
    return text;
}

std::string duration(double seconds) {
    if (seconds >= 1) return rounded(seconds, 3) + " s";
    if (seconds >= 1e-3) return rounded(seconds * 1e3, 3) + " ms";
    return rounded(seconds * 1e6, 3) + " us";
}

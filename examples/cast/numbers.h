// Numbers to and from text, the same in every locale.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

/// Something that the user gave can't be used: `what()` is the one line to tell.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The text in quotes, fit for a line of its own: cut short if it is long, without control characters.
std::string in_quotes(std::string_view text);

/// All of `text` as one number; throws InputError with the reason if it is not one, or none that `Number` can hold.
template <class Number>
Number parse_number(std::string_view text) {
    // from_chars takes no plus sign.
    const std::string_view digits = text.starts_with('+') && !text.starts_with("+-") ? text.substr(1) : text;
    Number number{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
        throw InputError(in_quotes(text) + " is not a" + (std::is_integral_v<Number> ? " whole number" : " number"));
    if (error == std::errc::result_out_of_range) throw InputError(in_quotes(text) + " is out of range");
    if constexpr (std::is_floating_point_v<Number>)
        if (!std::isfinite(number)) throw InputError(in_quotes(text) + " is not finite");
    return number;
}

/// The fewest digits that are read back as the same number.
std::string shortest(float number);
std::string shortest(double number);

/// Rounded to so many significant digits, for people.
std::string rounded(double number, int digits = 9);

/// 247,265
std::string grouped(std::uint64_t number);

/// 12.3 ms
std::string duration(double seconds);

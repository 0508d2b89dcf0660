// A float whose masks never end a formula early: the same kernel without its branches, all decided at the end.
#pragma once

#include <pierce/kernels/number.h>

namespace pierce::bench {

struct Straight {
    struct Truth {
        bool value;
        friend Truth operator&(Truth x, Truth y) {
            return {static_cast<bool>(static_cast<int>(x.value) & static_cast<int>(y.value))};
        }
        friend Truth operator|(Truth x, Truth y) {
            return {static_cast<bool>(static_cast<int>(x.value) | static_cast<int>(y.value))};
        }
        friend constexpr bool none(Truth) { return false; }
    };
    float value = 0;

    Straight() = default;
    explicit Straight(float x) : value(x) {}

    friend Straight operator+(Straight x, Straight y) { return Straight(x.value + y.value); }
    friend Straight operator-(Straight x, Straight y) { return Straight(x.value - y.value); }
    friend Straight operator*(Straight x, Straight y) { return Straight(x.value * y.value); }
    friend Straight operator/(Straight x, Straight y) { return Straight(x.value / y.value); }
    friend Straight operator-(Straight x) { return Straight(-x.value); }
    friend Truth operator<(Straight x, Straight y) { return {x.value < y.value}; }
    friend Truth operator<=(Straight x, Straight y) { return {x.value <= y.value}; }
    friend Truth operator>(Straight x, Straight y) { return {x.value > y.value}; }
    friend Truth operator>=(Straight x, Straight y) { return {x.value >= y.value}; }
    friend Straight select(Truth t, Straight yes, Straight no) { return t.value ? yes : no; }
};

}  // namespace pierce::bench

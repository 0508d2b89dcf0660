// A number that counts what is done with it. Changing a sign, comparing and copying are free, as they are in the
// sources' counts.
#pragma once

#include <compare>

namespace pierce::test {

struct Counts {
    int additions = 0;
    int multiplications = 0;
    int divisions = 0;
};

struct Counted {
    static inline Counts counts;

    double value = 0;

    Counted() = default;
    explicit Counted(double x) : value(x) {}

    friend Counted operator+(const Counted& x, const Counted& y) {
        return ++counts.additions, Counted(x.value + y.value);
    }
    friend Counted operator-(const Counted& x, const Counted& y) {
        return ++counts.additions, Counted(x.value - y.value);
    }
    friend Counted operator*(const Counted& x, const Counted& y) {
        return ++counts.multiplications, Counted(x.value * y.value);
    }
    friend Counted operator/(const Counted& x, const Counted& y) {
        return ++counts.divisions, Counted(x.value / y.value);
    }
    friend Counted operator-(const Counted& x) { return Counted(-x.value); }
    friend auto operator<=>(const Counted& x, const Counted& y) { return x.value <=> y.value; }
    friend bool operator==(const Counted& x, const Counted& y) = default;
};

}  // namespace pierce::test

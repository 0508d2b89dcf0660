// The triangle test that Embree 2 had at the time of Baldwin and Weber's table: a vertex, two edges and the normal are
// stored, 12 numbers.
//
// Written from the published description (Wald et al. 2014; Baldwin and Weber 2016, section 4.1) and our own algebra:
// with d = to - from and s = from - a, Moller and Trumbore's triple products all have s x d in them, and det needs no
// edge at all:
//   det = -d . n     u det = E2 . (s x d)     v det = -E1 . (s x d)     t det = s . n
#pragma once

#include <pierce/kernels/concept.h>

namespace pierce::bench {

using kernels::operator-;  // triples are std::arrays: nothing is found by them
using kernels::cross;
using kernels::dot;
using kernels::none;

struct EmbreeStyle {
    template <class Number>
    struct Stored {
        kernels::Triple<Number> a;
        kernels::Triple<Number> e1;
        kernels::Triple<Number> e2;
        kernels::Triple<Number> normal;
    };

    template <class Scalar>
    Stored<Scalar> prepare(const Vec3<Scalar>& a, const Vec3<Scalar>& b, const Vec3<Scalar>& c) const {
        const auto p = kernels::triple(a);
        const auto e1 = kernels::triple(b) - p;
        const auto e2 = kernels::triple(c) - p;
        return {p, e1, e2, cross(e1, e2)};
    }

    template <class Number>
    kernels::Tested<Number> evaluate(const Stored<Number>& t, const kernels::Triple<Number>& from,
                                     const kernels::Triple<Number>& to) const {
        const Number zero{};
        const auto back = from - to;
        const Number det = dot(back, t.normal);
        kernels::Mask<Number> hit = det > zero;
        if (none(hit)) return {hit};
        const auto s = from - t.a;
        const auto r = cross(back, s);  // s x d
        const Number u = dot(t.e2, r);
        hit = hit & (u >= zero) & (u <= det);
        if (none(hit)) return {hit};
        const Number v = -dot(t.e1, r);
        hit = hit & (v >= zero) & ((det - u) - v >= zero);
        if (none(hit)) return {hit};
        const Number fraction = dot(s, t.normal);
        hit = hit & (fraction >= zero) & (fraction < det);
        if (none(hit)) return {hit};
        return kernels::divided(hit, fraction, u, v, det);
    }
};

}  // namespace pierce::bench

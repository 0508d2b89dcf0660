// Pairs with a given share of hits: made by construction, and counted.
#include <support/random.h>

#include "table1.h"

namespace pierce::bench {

namespace {

using test::Random;
using D = Vec3<double>;

struct Pair {
    std::array<D, 3> triangle;
    D from;
    D to;
};

Pair make_pair(bool hit, Misses misses, Random& random) {
    Pair pair{{random.in_cube(), random.in_cube(), random.in_cube()}, random.in_cube(), random.in_cube()};
    auto& t = pair.triangle;
    if (!hit && misses == Misses::anywhere) return pair;
    D w = random.weights();
    if (!hit) {  // anywhere in the plane within three times the triangle's size, but not inside
        do w = D(0, random.between(-1, 2), random.between(-1, 2));
        while (w[1] >= 0 && w[2] >= 0 && w[1] + w[2] <= 1);
        w[0] = 1 - w[1] - w[2];
    }
    if ((t[1] - t[0])[0] * ((t[2] - t[0])[1] * (pair.from - t[0])[2] - (t[2] - t[0])[2] * (pair.from - t[0])[1]) -
            (t[1] - t[0])[1] * ((t[2] - t[0])[0] * (pair.from - t[0])[2] - (t[2] - t[0])[2] * (pair.from - t[0])[0]) +
            (t[1] - t[0])[2] * ((t[2] - t[0])[0] * (pair.from - t[0])[1] - (t[2] - t[0])[1] * (pair.from - t[0])[0]) <
        0) {
        std::swap(t[1], t[2]);
        std::swap(w[1], w[2]);
    }
    const D target = w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
    pair.to = target + random.between(0.1, 1) * (target - pair.from);
    return pair;
}

}  // namespace

Pairs make_pairs(std::size_t count, double hit_rate, Misses misses) {
    Random random(1);
    Pairs pairs;
    pairs.triangles.reserve(count);
    pairs.from.reserve(count);
    pairs.to.reserve(count);
    // Exactly the share that is asked for, in random order: of those that are left, as many hits as are left.
    auto left = static_cast<std::size_t>(hit_rate * static_cast<double>(count) + 0.5);
    while (pairs.size() < count) {
        const bool hit = random.below(count - pairs.size()) < left;
        for (;;) {
            const Pair pair = make_pair(hit, misses, random);
            const std::array<Vec3<float>, 3> t = {pair.triangle[0].cast<float>(), pair.triangle[1].cast<float>(),
                                                  pair.triangle[2].cast<float>()};
            const Vec3<float> from = pair.from.cast<float>();
            const Vec3<float> to = pair.to.cast<float>();
            if (kernels::exact.test(kernels::exact.prepare(t[0], t[1], t[2]), from, to).has_value() != hit) continue;
            pairs.triangles.push_back(t);
            pairs.from.push_back(kernels::triple(from));
            pairs.to.push_back(kernels::triple(to));
            break;
        }
        if (hit) {
            --left;
            ++pairs.hits;
        }
    }
    return pairs;
}

}  // namespace pierce::bench

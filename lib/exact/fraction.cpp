// Where along a segment its hits lie.
#include <exact/fraction.h>

#include <exact/ratio.h>
#include <exact/shares.h>
#include <exact/volumes.h>

namespace pierce::detail {

int compare_fractions(const Path& path, const Corners& first, const Corners& second) {
    Lattice lattice = lattice_of(path, first);
    for (const Point& corner : second) lattice.add(corner);
    return with_limbs(
        lattice.bits(),
        [&]<int N>(std::integral_constant<int, N>) {
            return compare_shares(Volumes<N>(path, first, lattice), Volumes<N>(path, second, lattice));
        },
        [&] { return compare_shares(WideVolumes(path, first, lattice), WideVolumes(path, second, lattice)); });
}

int compare_fractions(const Path& one, const Corners& first, const Path& other, const Corners& second) {
    const Lattice lattice = lattice_of(one, first);
    const Lattice lattice_of_other = lattice_of(other, second);
    return with_limbs(
        std::max(lattice.bits(), lattice_of_other.bits()),
        [&]<int N>(std::integral_constant<int, N>) {
            return compare_shares(Volumes<N>(one, first, lattice), Volumes<N>(other, second, lattice_of_other));
        },
        [&] { return compare_shares(WideVolumes(one, first, lattice), WideVolumes(other, second, lattice_of_other)); });
}

bool same_place(const Corners& first, const Decision& one, const Corners& second, const Decision& two) {
    if (one.feature == Feature::face || one.feature != two.feature) return false;
    const Point& p = first[one.feature_index];
    const Point& q = second[two.feature_index];
    if (one.feature == Feature::vertex) return p == q;
    const Point& p_next = first[(one.feature_index + 1U) % 3];
    const Point& q_next = second[(two.feature_index + 1U) % 3];
    return (p == q && p_next == q_next) || (p == q_next && p_next == q);
}

bool in_one_axis_plane(const Corners& first, const Corners& second) {
    for (std::size_t k = 0; k < 3; ++k) {
        const double x = first[0][k];
        if (first[1][k] == x && first[2][k] == x && second[0][k] == x && second[1][k] == x && second[2][k] == x)
            return true;
    }
    return false;
}

int compare_fraction(const Path& path, const Corners& corners, double limit) {
    return with_volumes(path, corners, [limit](const auto& volumes) { return compare_share(volumes, limit); });
}

bool fraction_at_most(const Path& path, const Corners& corners, double limit) {
    if (!(limit >= 0)) return false;
    return limit >= 1 || compare_fraction(path, corners, limit) <= 0;
}

Measures measure(const Path& path, const Corners& corners) {
    return with_volumes(path, corners, [](const auto& volumes) {
        const auto a = magnitude(volumes.from_side());
        const auto sum = a + magnitude(volumes.to_side());
        Measures measures{};
        measures.fraction = ratio(a, sum);
        for (int k = 0; k < 3; ++k)
            measures.barycentric[static_cast<std::size_t>(k)] = ratio(magnitude(volumes.weight(k)), sum);
        return measures;
    });
}

double measure_parameter(const Path& path, const Corners& corners) {
    return with_volumes(path, corners, [&path](const auto& volumes) {
        const auto a = magnitude(volumes.from_side());
        return ratio(a, a + magnitude(volumes.to_side()), path.exponent);
    });
}

}  // namespace pierce::detail

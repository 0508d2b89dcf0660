#include "segment_sets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>  // cross

#include <support/segments.h>

namespace pierce::bench {
namespace {

using Vector = Vec3<double>;

class Maker {
  public:
    Maker(const MeshView<float>& mesh, std::uint64_t seed) : mesh_(mesh), extent_(mesh), random_(seed) {
        double area = 0;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) areas_.push_back(area += scaled_normal(t).norm());
    }

    Segment<float> make(SegmentSet set) {
        switch (set) {
            case SegmentSet::short_02:
                return near_surface(0.002);
            case SegmentSet::short_1:
                return near_surface(0.01);
            case SegmentSet::medium:
                return near_surface(0.1);
            case SegmentSet::aimed:
                return aimed();
            case SegmentSet::random:
                return along(in_box(), 0.5);
            case SegmentSet::cloud:
                return along(in_box(), 0.0025);
            case SegmentSet::rest:
                return resting();
            case SegmentSet::axis:
                return on_lattice();
        }
        return {};
    }

  private:
    struct Place {
        Vector point;
        std::size_t triangle;
    };

    [[nodiscard]] Vector scaled_normal(std::size_t t) const {
        const Vector a = test::corner(mesh_, t, 0);
        return (test::corner(mesh_, t, 1) - a).cross(test::corner(mesh_, t, 2) - a);
    }

    Place on_surface() {
        std::size_t t = random_.below(areas_.size());
        if (random_.chance(0.5)) {
            const auto at = std::upper_bound(areas_.begin(), areas_.end(), random_.between(0, areas_.back()));
            t = std::min(static_cast<std::size_t>(at - areas_.begin()), areas_.size() - 1);
        }
        const Vector w = random_.weights();
        return {w[0] * test::corner(mesh_, t, 0) + w[1] * test::corner(mesh_, t, 1) + w[2] * test::corner(mesh_, t, 2),
                t};
    }

    Vector in_box() {
        const double x = random_.unit();
        const double y = random_.unit();
        return extent_.low + (extent_.high - extent_.low).cwiseProduct(Vector(x, y, random_.unit()));
    }

    /// A vector in a random direction, at most `length` diagonals long.
    Vector within(double length) { return length * extent_.diagonal() * random_.unit() * random_.direction(); }

    Segment<float> near_surface(double length) {
        const Vector from = on_surface().point + within(length);
        return rounded(from, from + length * extent_.diagonal() * random_.direction());
    }

    Segment<float> along(const Vector& middle, double half) {
        const Vector way = half * extent_.diagonal() * random_.direction();
        return rounded(middle - way, middle + way);
    }

    Segment<float> aimed() {
        const Vector a = on_surface().point + within(0.01);
        const Vector b = on_surface().point + within(0.01);
        return rounded(a - 0.5 * (b - a), b + 0.5 * (b - a));
    }

    Segment<float> resting() {
        const double step = 0.0002 * extent_.diagonal();
        const Place place = on_surface();
        const Vector scaled = scaled_normal(place.triangle);
        const Vector normal = scaled.norm() > 0 ? Vector(scaled.normalized()) : Vector(0, 0, 1);
        const Vector from = place.point + (random_.chance(0.5) ? random_.between(0, 2 * step) : 0) * normal;
        return rounded(from, from - step * normal);
    }

    Segment<float> on_lattice() {
        constexpr int cells = 64;
        std::array<int, 3> at{};
        for (int& k : at) k = random_.between_ints(0, cells);
        const std::size_t axis = random_.below(3);
        const int steps = 1 << (2 * random_.below(4));
        std::array<int, 3> end = at;
        end[axis] = std::clamp(at[axis] + (random_.chance(0.5) ? steps : -steps), 0, cells);
        if (end == at) end[axis] = at[axis] == 0 ? 1 : at[axis] - 1;
        return rounded(lattice_point(at), lattice_point(end));
    }

    [[nodiscard]] Vector lattice_point(const std::array<int, 3>& at) const {
        return extent_.low + (extent_.high - extent_.low).cwiseProduct(Vector(at[0], at[1], at[2]) / 64);
    }

    static Segment<float> rounded(const Vector& from, const Vector& to) {
        return {from.cast<float>(), to.cast<float>()};
    }

    const MeshView<float>& mesh_;
    test::Extent<float> extent_;
    test::Random random_;
    std::vector<double> areas_;  // summed
};

}  // namespace

std::string_view name_of(SegmentSet set) {
    constexpr std::array<std::string_view, k_segment_sets.size()> names = {"short0.2", "short1", "medium", "aimed",
                                                                           "random",   "cloud",  "rest",   "axis"};
    return names[static_cast<std::size_t>(set)];
}

std::string_view description_of(SegmentSet set) {
    constexpr std::array<std::string_view, k_segment_sets.size()> texts = {
        "0.2 % of the diagonal, starting within that length of the surface, in a random direction",
        "1 % of the diagonal, starting within that length of the surface, in a random direction",
        "10 % of the diagonal, starting within that length of the surface, in a random direction",
        "long: through two points within 1 % of the surface, and half their distance beyond each",
        "long: a diagonal, in a random direction through a point of the box",
        "0.5 % of the diagonal, anywhere in the box",
        "resting particles: from a face or just above it, 0.02 % of the diagonal against its normal",
        "parallel to an axis, on a lattice of 64^3 cells, 1 to 64 cells long"};
    return texts[static_cast<std::size_t>(set)];
}

std::vector<Segment<float>> make_segments(SegmentSet set, const MeshView<float>& mesh, std::size_t count) {
    Maker maker(mesh, 100 + static_cast<std::uint64_t>(set));
    std::vector<Segment<float>> segments;
    segments.reserve(count);
    while (segments.size() < count) {
        const Segment<float> s = maker.make(set);
        if (s.from != s.to) segments.push_back(s);  // CGAL must not be asked about these
    }
    return segments;
}

}  // namespace pierce::bench

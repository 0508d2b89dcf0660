// Targets of slides: exactly in front of every plane, and no further from where they should be than they have to. The
// judge is rational arithmetic. Without a lift about half of them would be behind.
#include <gtest/gtest.h>
#include <query/grain.h>
#include <response/aim.h>
#include <response/mesh_cast.h>
#include <support/oracles.h>

#include "ramps.h"

namespace pierce::test {
namespace {

using detail::Corners;
using detail::Point;

// The cast of a mesh but for the mesh.
struct Planes {
    using Surface = detail::MeshCast<double>::Surface;
    double unit;
    [[nodiscard]] double grain() const { return detail::k_grain_units * unit; }
    [[nodiscard]] static bool in_front(const Surface& surface, const Point& /*from*/, const Point& point) {
        return detail::side_of(surface.corners, point) * surface.side > 0;
    }
};

int exact_side(const Corners& corners, const Point& point) {
    const auto side = RationalOracle({point, point}, corners).from_side();
    return side < 0 ? -1 : side > 0 ? 1 : 0;
}

struct Counts {
    int aimed = 0;
    int behind = 0;
    int behind_unaimed = 0;
    double highest = 0;  ///< above a plane, in grains
};

// Triangles through a point, at rest near them, and ways along them (or their crease), of up to `reach` triangles.
// Heights are taken for greater than they are by up to `vague` units: then only the exact question helps.
template <class Scalar>
Counts aim_at_random(double offset, std::size_t planes, double reach, double vague, int count) {
    Random random(31);
    Counts counts;
    const auto rounded = [](const V& p) { return detail::to_point(Vec3<Scalar>(p.template cast<Scalar>())); };
    const Planes cast{detail::last_place<Scalar>(offset + 10)};
    for (int i = 0; i < count; ++i) {
        const V middle = offset * V(1, -1, 1) + random.in_cube();
        const V up = random.direction();
        std::vector<detail::Plane<Planes::Surface>> all;
        V along = random.direction();
        for (std::size_t k = 0; k < planes; ++k) {
            // Within 70 degrees of a common direction: there is room in front of all.
            const V n = (up + 0.9 * random.direction()).normalized();
            const V u = n.unitOrthogonal();
            const V w = n.cross(u);
            const double turn = random.between(0, 6);
            Corners corners{};
            for (int c = 0; c < 3; ++c)
                corners[static_cast<std::size_t>(c)] =
                    rounded(middle + std::cos(turn + 2 * c) * u + std::sin(turn + 2 * c) * w);
            const auto at = [&](std::size_t c) { return V(corners[c][0], corners[c][1], corners[c][2]); };
            const V normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
            const int side = random.chance(0.5) ? 1 : -1;
            if (side < 0) std::swap(corners[0], corners[1]);
            // (A cross product of what is nearly parallel is not normal to it, so it is made so again.)
            if (k == 0)
                along = normal.cross(normal.cross(along).normalized());
            else
                along = V(all[0].normal[0], all[0].normal[1], all[0].normal[2]).cross(normal);
            all.push_back({{normal[0], normal[1], normal[2]}, 0, {corners, side}, static_cast<std::uint32_t>(k)});
        }
        V from = middle + up * cast.grain() * random.between(0, 4);
        const Point start = rounded(from);
        from = V(start[0], start[1], start[2]);
        bool in_front = true;
        for (auto& plane : all) {
            const V corner(plane.surface.corners[0][0], plane.surface.corners[0][1], plane.surface.corners[0][2]);
            plane.height = V(plane.normal[0], plane.normal[1], plane.normal[2]).dot(from - corner);
            in_front = in_front && exact_side(plane.surface.corners, start) * plane.surface.side > 0;
        }
        if (!in_front) continue;
        const V way = reach * random.unit() * along.normalized();
        Point target{};
        auto told = all;
        for (auto& plane : told) plane.height += vague * cast.unit * random.unit();
        detail::aim<Scalar>(cast, start, {way[0], way[1], way[2]}, told, target);
        ++counts.aimed;
        // On the planes themselves, as the book has it.
        V flat = from + way;
        for (int round = 0; round < 50; ++round)
            for (const auto& plane : all) {
                const V n(plane.normal[0], plane.normal[1], plane.normal[2]);
                flat -= n * (plane.height + n.dot(flat - from));
            }
        bool behind = false;
        bool flat_behind = false;
        for (const auto& plane : all) {
            behind = behind || exact_side(plane.surface.corners, target) * plane.surface.side <= 0;
            flat_behind = flat_behind || exact_side(plane.surface.corners, rounded(flat)) * plane.surface.side <= 0;
        }
        counts.behind += behind ? 1 : 0;
        counts.behind_unaimed += flat_behind ? 1 : 0;
        for (const auto& plane : all) {
            const V n(plane.normal[0], plane.normal[1], plane.normal[2]);
            const double height = plane.height + n.dot(V(target[0], target[1], target[2]) - from);
            counts.highest = std::max(counts.highest, height / cast.grain());
        }
    }
    return counts;
}

template <class Scalar>
void expect_certain() {
    for (const double offset : {0.0, 1e3, 1e6})
        for (const std::size_t planes : {1U, 2U})
            for (const auto& [reach, vague] : {std::pair{1e-3, 0.0}, {1.0, 0.0}, {30.0, 0.0}, {1.0, 8.0}}) {
                const Counts counts = aim_at_random<Scalar>(offset, planes, reach, vague, 1000);
                std::cout << "offset " << offset << ", " << planes << " planes, reach " << reach << ", vague " << vague
                          << ": " << counts.aimed << " aimed, " << counts.behind << " behind, " << counts.behind_unaimed
                          << " without; highest " << counts.highest << " grains\n";
                EXPECT_GT(counts.aimed, 300);
                EXPECT_EQ(counts.behind, 0) << offset << ' ' << planes << ' ' << reach;
                EXPECT_GT(counts.behind_unaimed, counts.aimed / 4);
                EXPECT_LT(counts.highest, 6) << offset << ' ' << planes << ' ' << reach;
            }
}

TEST(Aim, targets_are_in_front_of_every_plane) {
    expect_certain<float>();
    expect_certain<double>();
}

}  // namespace
}  // namespace pierce::test

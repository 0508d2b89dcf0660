// The naive twin of World: no tree. Each mesh is asked by itself about the images of the ends, and hits are put in
// order by their fractions as rationals.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include <gmpxx.h>
#include <pierce/triangle_soup.h>
#include <pierce/world.h>
#include <Eigen/Geometry>

namespace pierce::test {

template <class Scalar>
std::shared_ptr<const CollisionMesh<Scalar>> shared_mesh(const TriangleSoup<Scalar>& soup) {
    return std::make_shared<const CollisionMesh<Scalar>>(soup.view());
}

/// A rotation by an angle about a direction, from a quaternion of small whole numbers: no sine, which differ between C
/// libraries.
template <class Scalar>
Eigen::Matrix<Scalar, 3, 3> rotation_of(int w, int x, int y, int z) {
    const double n = w * w + x * x + y * y + z * z;
    Eigen::Matrix3d r;
    r << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
        2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),   //
        2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
    return (r / n).template cast<Scalar>();
}

template <class Scalar>
class NaiveWorld {
  public:
    struct Member {
        MeshId id;
        TriangleSoup<Scalar> soup;
        std::shared_ptr<const CollisionMesh<Scalar>> mesh;
        std::uint32_t layers = 0xffffffff;
        std::vector<std::uint32_t> face_layers = {};  ///< empty: all bits are set
        Pose<Scalar> pose = {};
    };
    struct Answer {
        const Member* member;
        Hit<Scalar> local;
        mpq_class fraction;
    };

    explicit NaiveWorld(const World<Scalar>& of) : world(of) {}

    [[nodiscard]] Segment<Scalar> image(const Member& member, const Segment<Scalar>& segment) const {
        return {world.to_mesh(member.id, segment.from), world.to_mesh(member.id, segment.to)};
    }

    /// All hits in order.
    [[nodiscard]] std::vector<Answer> all_hits(const Segment<Scalar>& segment, const WorldOptions& options) const {
        std::vector<Answer> answers;
        for (const Member& member : members) {
            if ((member.layers & options.mask) == 0) continue;
            const Segment<Scalar> local = image(member, segment);
            std::vector<std::uint8_t> mask;
            const QueryOptions here = options_in(member, options, mask);
            std::vector<Hit<Scalar>> hits(member.mesh->all_hits(local, {}, here));
            member.mesh->all_hits(local, hits, here);
            for (const Hit<Scalar>& hit : hits)
                answers.push_back({&member, hit, fraction_of(member, local, hit.triangle)});
        }
        std::sort(answers.begin(), answers.end(), [](const Answer& x, const Answer& y) {
            if (x.fraction != y.fraction) return x.fraction < y.fraction;
            if (x.member != y.member) return x.member->id.index < y.member->id.index;
            return x.local.face != y.local.face ? x.local.face < y.local.face : x.local.triangle < y.local.triangle;
        });
        return answers;
    }

    /// The options as a mesh understands them; `mask` is for what they refer to.
    [[nodiscard]] QueryOptions options_in(const Member& member, const WorldOptions& options,
                                          std::vector<std::uint8_t>& mask) const {
        QueryOptions here{.sides = options.sides, .max_fraction = options.max_fraction};
        for (const std::uint32_t bits : member.face_layers) mask.push_back((bits & options.mask) != 0 ? 1 : 0);
        here.face_mask = mask;
        if (options.accept)
            here.accept = [&options, id = member.id](const Contact& contact) { return options.accept(id, contact); };
        return here;
    }

    /// Whether the way to a point has a hit in any mesh, by the rule for images.
    [[nodiscard]] bool stopped(const Segment<Scalar>& way, const WorldOptions& options) const {
        WorldOptions whole = options;
        whole.max_fraction = std::numeric_limits<double>::infinity();
        return !all_hits(way, whole).empty();
    }

    const World<Scalar>& world;
    std::vector<Member> members;

    /// How far the image of a point is from the plane of a hit, on the side of the image of `from`; less than 0: it is
    /// on the other.
    [[nodiscard]] double distance(const Answer& answer, const Vec3<Scalar>& from, const Vec3<Scalar>& point) const {
        const Member& member = *answer.member;
        const IndexTriple& t = member.soup.triangles[answer.local.triangle];
        std::array<Vec3<double>, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = member.soup.positions[t[k]].template cast<double>();
        const Segment<Scalar> local = image(member, {from, point});
        const double length = (p[1] - p[0]).cross(p[2] - p[0]).norm();
        const double side = mpq_class(side_of(member, answer.local.triangle, local.to)).get_d() / length;
        return answer.local.side == Sides::front ? side : -side;
    }

    /// The exact fraction at which a way's image passes through a triangle's plane.
    static mpq_class fraction_of(const Member& member, const Segment<Scalar>& local, std::uint32_t triangle) {
        const mpq_class from = side_of(member, triangle, local.from);
        return from / (from - side_of(member, triangle, local.to));
    }

  private:
    static mpq_class side_of(const Member& member, std::uint32_t triangle, const Vec3<Scalar>& x) {
        using Q = std::array<mpq_class, 3>;
        const auto exact = [](const Vec3<Scalar>& v) { return Q{double(v[0]), double(v[1]), double(v[2])}; };
        const auto minus = [](const Q& p, const Q& q) { return Q{p[0] - q[0], p[1] - q[1], p[2] - q[2]}; };
        const IndexTriple& t = member.soup.triangles[triangle];
        const Q a = exact(member.soup.positions[t[0]]);
        const Q b = minus(exact(member.soup.positions[t[1]]), a);
        const Q c = minus(exact(member.soup.positions[t[2]]), a);
        const Q d = minus(exact(x), a);
        return (b[1] * c[2] - b[2] * c[1]) * d[0] + (b[2] * c[0] - b[0] * c[2]) * d[1] +
               (b[0] * c[1] - b[1] * c[0]) * d[2];
    }
};

}  // namespace pierce::test

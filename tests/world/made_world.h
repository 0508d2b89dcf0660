// A world of all kinds of meshes, poses, layers and changes, its naive twin, and queries that meet them.
#pragma once

#include <gtest/gtest.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <world/naive_world.h>

namespace pierce::test {

template <class Scalar>
struct MadeWorld {
    World<Scalar> world;
    NaiveWorld<Scalar> naive{world};
    std::vector<TriangleSoup<Scalar>> soups;
    std::vector<std::shared_ptr<const CollisionMesh<Scalar>>> meshes;
    double offset;
    Random random;

    MadeWorld(double where, std::uint64_t seed) : offset(where), random(seed) {
        for (std::uint64_t i = 0; i < 3; ++i) soups.push_back(moved<Scalar>(polycube(2, 0.6, 2, i), 1, {-2, -2, -2}));
        soups.push_back(moved<Scalar>(bumpy_sphere(3), 2, {0, 0, 0}));
        soups.push_back(moved<Scalar>(terrain(4, 0.3, 2), 3, {1, 0, 0}));
        for (const auto& soup : soups) meshes.push_back(shared_mesh(soup));
    }

    Vec3<Scalar> middle() {
        const Vec3<double> shift(offset, -offset, offset);
        return (shift + 5 * random.in_cube()).template cast<Scalar>();
    }
    Pose<Scalar> pose() {
        Pose<Scalar> pose;
        const double kind = random.unit();
        if (kind < 0.15 && offset == 0) return pose;
        pose.translation = middle();
        if (kind < 0.3) pose.translation = pose.translation.array().round();
        if (kind < 0.4) return pose;
        pose.rotation = rotation_of<Scalar>(1 + random.between_ints(0, 5), random.between_ints(-5, 5),
                                            random.between_ints(-5, 5), random.between_ints(-5, 5));
        if (kind < 0.5) pose.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
        return pose;
    }
    void add() {
        const std::size_t which = random.below(meshes.size());
        InstanceOptions<Scalar> options;
        options.pose = pose();
        options.layers = 1U << random.below(3) | (random.chance(0.5) ? 8U : 0U);
        typename NaiveWorld<Scalar>::Member member{{}, soups[which], meshes[which], options.layers, {}, options.pose};
        if (random.chance(0.3)) {
            std::vector<std::uint32_t> layers;
            for (std::size_t i = 0; i < soups[which].triangles.size() - 2; ++i)
                layers.push_back(static_cast<std::uint32_t>(random.below(16)));
            member.face_layers = layers;
            options.face_layers = std::make_shared<const std::vector<std::uint32_t>>(layers);
        }
        member.id = world.add(meshes[which], options);
        naive.members.push_back(std::move(member));
    }
    void change() {
        if (naive.members.empty() || random.chance(0.2)) return add();
        const std::size_t at = random.below(naive.members.size());
        auto& member = naive.members[at];
        const double kind = random.unit();
        if (kind < 0.2) {
            EXPECT_TRUE(world.remove(member.id));
            naive.members.erase(naive.members.begin() + static_cast<std::ptrdiff_t>(at));
        } else if (kind < 0.4) {
            const std::size_t which = random.below(meshes.size());
            world.replace(member.id, meshes[which]);
            member.soup = soups[which];
            member.mesh = meshes[which];
        } else if (kind < 0.5) {
            member.layers = static_cast<std::uint32_t>(random.below(16));
            world.set_layers(member.id, member.layers);
        } else {
            member.pose = pose();
            world.set_pose(member.id, member.pose);
        }
    }
    Segment<Scalar> segment() {
        Segment<Scalar> out{middle(), middle()};
        if (naive.members.empty() || random.chance(0.3)) return out;
        // Through or to a place of a face, edge or vertex of some mesh.
        const auto& member = naive.members[random.below(naive.members.size())];
        const IndexTriple& t = member.soup.triangles[random.below(member.soup.triangles.size())];
        Vec3<double> w = random.weights();
        if (random.chance(0.3)) w = {1, 0, 0};
        Vec3<double> target(0, 0, 0);
        for (int k = 0; k < 3; ++k) target += w[k] * member.soup.positions[t[std::size_t(k)]].template cast<double>();
        const Vec3<Scalar> on = world.to_world(member.id, target.template cast<Scalar>());
        const double kind = random.unit();
        if (kind < 0.2)
            out.from = on;
        else if (kind < 0.4)
            out.to = on;
        else
            out.to = (out.from.template cast<double>() +
                      random.between(1, 2) * (on.template cast<double>() - out.from.template cast<double>()))
                         .template cast<Scalar>();
        return out;
    }
    WorldOptions options() {
        WorldOptions options;
        options.sides = static_cast<Sides>(random.below(3));
        if (random.chance(0.3)) options.mask = static_cast<std::uint32_t>(random.below(16));
        if (random.chance(0.2)) options.max_fraction = random.unit();
        if (random.chance(0.3))
            options.accept = [](MeshId id, const Contact& contact) { return (id.index + contact.triangle) % 3 != 0; };
        return options;
    }

    [[nodiscard]] bool has_all_faces(MeshId id) const {
        for (const auto& member : naive.members)
            if (member.id == id) return member.face_layers.empty();
        return false;
    }

    void expect_same(const WorldHit<Scalar>& hit, const typename NaiveWorld<Scalar>::Answer& answer) {
        const Hit<Scalar>& x = hit.hit;
        const Hit<Scalar>& y = answer.local;
        EXPECT_EQ(hit.mesh, answer.member->id);
        EXPECT_EQ(x.face, y.face);
        EXPECT_EQ(x.triangle, y.triangle);
        EXPECT_EQ(x.side, y.side);
        EXPECT_EQ(x.feature, y.feature);
        EXPECT_EQ(x.feature_index, y.feature_index);
        EXPECT_EQ(x.at_start, y.at_start);
        EXPECT_TRUE(same_bits(x.barycentric, y.barycentric));
        EXPECT_NEAR(double(x.exact_fraction), answer.fraction.get_d(), double(std::numeric_limits<Scalar>::epsilon()));
        EXPECT_LE(double(x.fraction), answer.fraction.get_d());
        EXPECT_TRUE(same_bits(x.position, Coordinates<Scalar>(world.to_world(hit.mesh, y.position.vec()))));
        EXPECT_NEAR(double(x.normal.norm()), 1, 1e-6);
    }
};

}  // namespace pierce::test

// Particles in and around a closed mesh that deforms: they ride on it, bounce off it and rest on it, and none gets to
// the other side. Judged by CGAL's exact predicates on the positions of each step.
#include <atomic>
#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include <deform/shapes.h>
#include <pierce/deforming_mesh.h>
#include <support/inside_oracle.h>
#include <support/meshes.h>
#include <support/random.h>

namespace pierce::test {
namespace {

template <class Scalar>
struct Particle {
    Vec3<Scalar> at;
    Vec3<double> velocity;  // per step
    bool inside;
    enum class Kind { rides, bounces, rests } kind;
};

struct Tally {
    int leaks = 0;
    int contacts = 0;
    int unverified = 0;
    int on_surface = 0;
};

template <class Scalar>
Vec3<Scalar> target_of(const Particle<Scalar>& p) {
    return (p.at.template cast<double>() + p.velocity).template cast<Scalar>();
}

/// Where a particle goes in a step. What it wants to do is tried twice after the first contact; then it stays on the
/// mesh.
template <class Scalar>
void move(Particle<Scalar>& p, const DeformationStep<Scalar>& step, const QueryOptions& options, Tally& tally) {
    if (p.kind == Particle<Scalar>::Kind::rests) p.velocity += Vec3<double>(0, 0, -0.002);
    for (int attempt = 0;; ++attempt) {
        const Vec3<Scalar> target = target_of(p);
        const auto hit = step.sweep({p.at, target}, options);
        if (!hit) {
            p.at = target;
            return;
        }
        ++tally.contacts;
        const Vec3<double> normal = hit->facing().template cast<double>();
        const Vec3<double> surface = hit->surface_motion.template cast<double>();
        const double approach = normal.dot(p.velocity - surface);
        const double restitution = p.kind == Particle<Scalar>::Kind::bounces ? 0.9 : 0;
        if (p.kind == Particle<Scalar>::Kind::rides)
            p.velocity = Vec3<double>::Zero();
        else
            p.velocity -= (1 + restitution) * std::min(approach, 0.0) * normal;
        if (p.velocity.norm() > 0.3) p.velocity *= 0.3 / p.velocity.norm();
        if (attempt < 2 && p.kind != Particle<Scalar>::Kind::rides) continue;
        tally.unverified += hit->place_verified ? 0 : 1;
        if (hit->place_verified) p.at = hit->place.vec();
        return;
    }
}

template <class Scalar>
Tally play(Shape shape, int n, int count, int steps, double pace, double offset, std::uint64_t seed) {
    const TriangleSoup<double> rest = star(n, [](const Vec3<double>&) { return 1.0; });
    TriangleSoup<Scalar> soup{shaped<Scalar>(rest, shape, 0, offset), rest.triangles, {}};
    DeformingMesh<Scalar> mesh(soup.view());
    Random random(seed);
    std::vector<Particle<Scalar>> particles;
    while (static_cast<int>(particles.size()) < count) {
        const Vec3<Scalar> at = (1.6 * random.in_cube() + Vec3<double>::Constant(offset)).template cast<Scalar>();
        const Location where = mesh.step().before().locate(at);
        if (where.place == Place::on_surface) continue;
        using Kind = typename Particle<Scalar>::Kind;
        const auto kind = std::array{Kind::rides, Kind::bounces, Kind::rests}[particles.size() % 3];
        particles.push_back({at, 0.05 * random.in_cube(), where.place == Place::inside, kind});
    }
    Tally tally;
    for (int s = 1; s <= steps; ++s) {
        soup.positions = shaped<Scalar>(rest, shape, pace * s, offset);
        mesh.begin_step(soup.positions);
        const DeformationStep<Scalar> step = mesh.step();
        for (Particle<Scalar>& p : particles) move(p, step, {.sides = p.inside ? Sides::back : Sides::front}, tally);
        const InsideOracle<Scalar> oracle(soup);
        for (Particle<Scalar>& p : particles) {
            const CGAL::Bounded_side side = oracle.side(p.at);
            if (side == CGAL::ON_BOUNDARY)
                ++tally.on_surface;
            else if ((side == CGAL::ON_BOUNDED_SIDE) != p.inside)
                ++tally.leaks, p.inside = !p.inside;
        }
    }
    return tally;
}

template <class Scalar>
class Rides : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Rides, Scalars);

template <class Scalar>
void expect_no_leaks(int n, int count, int steps) {
    std::uint64_t seed = 0;
    for (const Shape shape : {beating, twisting, waving})
        for (const double pace : {0.02, 0.15})
            for (const double offset : {0.0, 1000.0}) {
                const Tally tally = play<Scalar>(shape, n, count, steps, pace, offset, ++seed);
                EXPECT_EQ(tally.leaks, 0) << "shape " << seed;
                EXPECT_EQ(tally.unverified, 0) << "shape " << seed;
                EXPECT_GT(tally.contacts, count * steps / 80) << "shape " << seed;
                if (testing::Test::HasFailure()) return;
            }
}

TYPED_TEST(Rides, NobodyGetsThrough) { expect_no_leaks<TypeParam>(4, 40, 60); }
TYPED_TEST(Rides, NobodyGetsThroughSoak) { expect_no_leaks<TypeParam>(10, 1000, 1000); }

// Whoever asks while a step is made, here on the very threads that make it, sees the one before.
TYPED_TEST(Rides, TheOldStepIsSeenUntilTheNextIsMade) {
    using Scalar = TypeParam;
    TriangleSoup<Scalar> soup = moved<Scalar>(star(64, [](const Vec3<double>&) { return 1.0; }), 1, {0, 0, 0});
    DeformingMesh<Scalar> mesh(soup.view());
    const auto size_of = [](const CollisionMesh<Scalar>& state) {
        return state.first_hit(Segment<Scalar>{{0, 0, 0}, {0, 0, 1000}}, {.sides = Sides::both})->position[2];
    };
    int asked = 0;
    for (int size = 2; size < 6; ++size) {
        for (Vec3<Scalar>& p : soup.positions) p *= Scalar(size) / Scalar(size - 1);
        const Scalar last = size_of(mesh.step().after());
        const auto asks = [&](std::size_t parts, Task task) {
            EXPECT_EQ(size_of(mesh.step().after()), last);
            ++asked;
            for (std::size_t i = 0; i < parts; ++i) task(i);
        };
        mesh.begin_step(soup.positions, std::cref(asks));
        EXPECT_EQ(size_of(mesh.step().before()), last);
        EXPECT_GT(size_of(mesh.step().after()), last + Scalar(0.5));
    }
    EXPECT_GT(asked, 10);
}

// Readers ask while steps are made; each sees one whole step.
TYPED_TEST(Rides, ReadersSeeWholeSteps) {
    using Scalar = TypeParam;
    const TriangleSoup<double> rest = star(6, [](const Vec3<double>&) { return 1.0; });
    const TriangleSoup<Scalar> soup = moved<Scalar>(rest, 1, {0, 0, 0});
    // The sphere is as large as its step's number says, so that a step can be read from its answers.
    const auto sized = [&](int size) {
        std::vector<Vec3<Scalar>> positions = soup.positions;
        for (Vec3<Scalar>& p : positions) p *= static_cast<Scalar>(size);
        return positions;
    };
    DeformingMesh<Scalar> mesh(soup.view(), {.rebuild_above = 0});  // a new order in each step
    DeformingMesh<Scalar> refitted(soup.view());
    std::atomic<bool> done = false;
    std::atomic<int> wrong = 0;
    std::atomic<int> asked = 0;
    std::vector<std::thread> readers;
    for (int i = 0; i < 3; ++i)
        readers.emplace_back([&] {
            while (!done) {
                for (const DeformingMesh<Scalar>* which : {&mesh, &refitted}) {
                    const DeformationStep<Scalar> step = which->step();
                    const Segment<Scalar> out{{0, 0, 0}, {0, 0, 1000}};
                    const auto before = step.before().first_hit(out, {.sides = Sides::both});
                    const auto after = step.after().first_hit(out, {.sides = Sides::both});
                    const auto between = step.sweep({{0, 0, 1000}, {0, 0, -1000}});
                    ++asked;
                    if (!before || !after || !between) {
                        ++wrong;
                        continue;
                    }
                    const Scalar first = before->position[2], second = after->position[2];
                    if (std::round(first) != first || (second != first + 1 && second != first)) ++wrong;
                    // 1000 - 2000 t = first + (second - first) t
                    const Scalar t = (1000 - first) / (2000 + (second - first));
                    if (std::abs(between->time - t) > Scalar(1e-5)) ++wrong;
                }
            }
        });
    // One larger in each step, from the first one on, which is of size 1.
    for (int size = 2; size <= 500 && (size < 60 || asked < 100); ++size) {
        const std::vector<Vec3<Scalar>> positions = sized(size);
        mesh.begin_step(positions);
        refitted.begin_step(positions);
    }
    done = true;
    for (std::thread& reader : readers) reader.join();
    EXPECT_EQ(wrong, 0);
    EXPECT_GE(asked, 100);
}

}  // namespace
}  // namespace pierce::test

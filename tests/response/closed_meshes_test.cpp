// Particles slide and bounce in closed real meshes, near and far from the origin: none gets out, and what rests stays
// where it is. The judge is the exact winding number, by the rule for counting, which moves do not use.
// Far away in float a mesh is coarse, and folds over itself: it is still closed, so winding numbers must
// stay.
#include <ctime>
#include <string>
#include <tuple>

#include <gtest/gtest.h>
#include <support/real_meshes.h>

#include "ramps.h"

namespace pierce::test {
namespace {

struct Outcome {
    std::size_t particles = 0;
    std::size_t leaked = 0;
    std::size_t restless = 0;  ///< moved after they had come to rest
    std::size_t resting = 0;   ///< in the end
    std::size_t wedged = 0;
    std::size_t jittering = 0;  ///< in the last twenty steps: back and forth
    std::size_t contacts = 0;
    std::size_t undone = 0;  ///< moves that had a remainder
    std::size_t casts = 0;
};

template <class Scalar>
Outcome run(const TriangleSoup<double>& unit, double offset, std::size_t particles, int steps, bool bounces) {
    Eigen::AlignedBox3d box;
    for (const V& p : unit.positions) box.extend(p);
    const double size = 20 / box.diagonal().maxCoeff();
    const TriangleSoup<Scalar> soup = moved<Scalar>(unit, size, offset * V(1, -1, 1) - size * box.center());
    const CollisionMesh<Scalar> mesh(soup.view());
    const MoveOptions<Scalar> options{
        .query = {.sides = Sides::both},
        .response = {
            .restitution = Scalar(0.4), .friction = Scalar(0.9), .rest_speed = Scalar(2 * 9.81 / 60 / (1 - 0.4))}};
    Random random(21);
    std::vector<Vec3<Scalar>> x, v;
    std::vector<int> winding;
    for (int attempt = 0; attempt < 400 && x.size() < particles; ++attempt) {
        std::vector<Vec3<Scalar>> tried;
        for (std::size_t i = 0; i < particles; ++i)
            tried.push_back(
                V(offset * V(1, -1, 1) + size * 0.5 * random.in_cube().cwiseProduct(box.diagonal())).cast<Scalar>());
        std::vector<int> numbers(tried.size());
        mesh.winding_numbers(tried, numbers);
        for (std::size_t i = 0; i < tried.size() && x.size() < particles; ++i) {
            // (Far away in float many lattice points are corners of the mesh.)
            if (numbers[i] == 0 || mesh.locate(tried[i]).place != Place::inside) continue;
            x.push_back(tried[i]);
            v.push_back(V(5 * random.in_cube()).cast<Scalar>());
            winding.push_back(numbers[i]);
        }
    }
    Outcome outcome;
    outcome.particles = x.size();
    std::vector<Move<Scalar>> moves(x.size());
    std::vector<std::uint8_t> rested(x.size(), 0);
    std::vector<int> returns(x.size(), 0);
    std::vector<std::array<Vec3<Scalar>, 4>> before(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) before[i].fill(x[i]);
    const Vec3<Scalar> push(0, 0, Scalar(-9.81 / 60));
    for (int step = 0; step < steps; ++step) {
        for (Vec3<Scalar>& velocity : v) velocity += push;
        move_all_either(bounces, mesh, x, v, Scalar(1) / 60, moves, options);
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Move<Scalar>& move = moves[i];
            const bool rests = move.velocity == Vec3<Scalar>::Zero() && move.state != MoveState::free;
            if (rested[i] != 0 && (!rests || !same_bits(move.position, x[i]))) ++outcome.restless;
            // One that has just come to rest was pushed otherwise.
            rested[i] = rests && same_bits(move.position, x[i]) && v[i] == push ? 1 : 0;
            // Of the last places; what swings comes back to one of them now and then, what jitters all the time.
            const bool back = std::any_of(before[i].begin(), before[i].end(),
                                          [&](const auto& place) { return same_bits(place, move.position); });
            if (step >= steps - 20 && back && !same_bits(move.position, x[i])) ++returns[i];
            before[i][static_cast<std::size_t>(step) % before[i].size()] = x[i];
            outcome.contacts += move.contacts;
            outcome.casts += static_cast<std::size_t>(move.casts);
            outcome.undone += move.remainder != Vec3<Scalar>::Zero() ? 1U : 0U;
            x[i] = move.position;
            v[i] = move.velocity;
        }
    }
    std::vector<int> numbers(x.size());
    mesh.winding_numbers(x, numbers);
    for (std::size_t i = 0; i < x.size(); ++i) {
        outcome.leaked += numbers[i] != winding[i] ? 1U : 0U;
        outcome.jittering += returns[i] >= 5 ? 1U : 0U;
        outcome.resting += moves[i].state == MoveState::resting ? 1U : 0U;
        outcome.wedged += moves[i].state == MoveState::wedged ? 1U : 0U;
    }
    return outcome;
}

constexpr std::array<const char*, 3> k_closed = {"elephant", "knot1", "rotor"};

template <class Scalar>
void expect_kept(const char* name, double offset, std::size_t particles, int steps) {
    const TriangleSoup<double> unit = real_mesh<double>(name);
    const MeshReport report = CollisionMesh<double>(unit.view()).mesh_report();
    ASSERT_EQ(report.border_edges, 0U) << name;
    for (const bool bounces : {false, true}) {
        const std::clock_t start = std::clock();
        const Outcome o = run<Scalar>(unit, offset, particles, steps, bounces);
        const double took = 1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;  // of the process
        const double moves = static_cast<double>(o.particles) * steps;
        std::cout << name << ", offset " << offset << (bounces ? ", bouncing: " : ", sliding: ") << o.particles
                  << " particles, " << o.leaked << " leaked, " << o.restless << " restless, " << o.resting
                  << " resting, " << o.wedged << " wedged, " << o.jittering << " jittering, " << o.contacts
                  << " contacts, " << o.undone << " moves not done; " << took / moves << " ns a move, "
                  << static_cast<double>(o.casts) / moves << " queries\n";
        EXPECT_GT(o.particles, particles / 4) << name << ' ' << offset;
        EXPECT_EQ(o.leaked, 0U) << name << ' ' << offset;
        EXPECT_EQ(o.restless, 0U) << name << ' ' << offset;
        EXPECT_GT(o.contacts, o.particles * static_cast<std::size_t>(steps) / 10) << name << ' ' << offset;
        EXPECT_LE(o.undone, o.particles * static_cast<std::size_t>(steps) / 1000) << name << ' ' << offset;
        // Without friction some swing at the bottom of a fold for ever, in float by a few units.
        EXPECT_LE(o.jittering, bounces ? 0U : particles / 1000) << name << ' ' << offset;
    }
}

template <class Scalar>
class ClosedMeshes : public ::testing::Test {};
TYPED_TEST_SUITE(ClosedMeshes, Both);

TYPED_TEST(ClosedMeshes, keep_what_slides_and_bounces_in_them) {
    for (const char* name : k_closed)
        for (const double offset : {0.0, 1e3, 1e6}) expect_kept<TypeParam>(name, offset, 60, 200);
}

// Each mesh at each offset is a test of its own, so that parts can be run.
class ClosedMeshesSoak : public ::testing::TestWithParam<std::tuple<const char*, double>> {};
TEST_P(ClosedMeshesSoak, keep_floats) {
    expect_kept<float>(std::get<0>(GetParam()), std::get<1>(GetParam()), 10'000, 1000);
}
TEST_P(ClosedMeshesSoak, keep_doubles) {
    expect_kept<double>(std::get<0>(GetParam()), std::get<1>(GetParam()), 10'000, 1000);
}
INSTANTIATE_TEST_SUITE_P(Rooms, ClosedMeshesSoak,
                         ::testing::Combine(::testing::ValuesIn(k_closed), ::testing::Values(0.0, 1e3, 1e6)),
                         [](const auto& room) {
                             const int exponent = static_cast<int>(std::log10(std::get<1>(room.param) + 1) + 0.5);
                             return std::string(std::get<0>(room.param)) + "_at_" +
                                    (exponent == 0 ? "0" : "1e" + std::to_string(exponent));
                         });

}  // namespace
}  // namespace pierce::test

// all_hits with `accept`: the way to each hit's point is clear but for hits that were accepted, and come strictly
// before it.
//
//   from                 Two faces almost in the same place. `accept` refuses the contact of the caller's segment with
//     \                  the nearer one, by its barycentric weights (a hole in a texture, no larger than that); it
//   ---x---- refused     takes other contacts with it. The point that was returned for the farther hit lay behind the
//   ----x--- hit         nearer face, and as points are rounded, the segment from -> point met that face beside the
//       to               hole: a particle that was put there had gone through a face that counts. The search for the
//                        point took every face hit before as passed, accepted or not.
//
// What is asked depends on the contact only, as QueryOptions::accept must. first_hit and sweep are held to the same.
#include <gtest/gtest.h>
#include <exact/fraction.h>
#include <pierce/collision_mesh.h>
#include <pierce/triangle_soup.h>
#include <support/expect_hit.h>
#include <support/random.h>

namespace pierce::test {
namespace {

template <class Scalar>
struct Stack {
    TriangleSoup<Scalar> soup;
    Segment<Scalar> segment;
};

// Faces one above the other, from a tenth to a unit in the last place of their size apart, and a segment down through
// them.
template <class Scalar>
Stack<Scalar> stack(std::uint32_t faces, Random& random) {
    using S = Vec3<Scalar>;
    const auto near = [&] { return static_cast<Scalar>(random.between(-2, 2)); };
    const auto height = [&] { return static_cast<Scalar>(random.between(-0.3, 0.3)); };
    Stack<Scalar> out;
    const std::array<S, 3> first = {S(near(), near(), height()), S(near() + 3, near(), height()),
                                    S(near(), near() + 3, height())};
    const double least = std::log(static_cast<double>(std::numeric_limits<Scalar>::epsilon()));
    for (std::uint32_t i = 0; i < faces; ++i) {
        const double apart = i * std::exp(random.between(least, -2));
        for (S corner : first) {
            corner[2] -= static_cast<Scalar>(apart * (1 + 0.1 * random.unit()));
            out.soup.positions.push_back(corner);
        }
        out.soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const auto aside = [&] { return static_cast<Scalar>(random.unit()); };
    out.segment = {S(aside(), aside(), 2), S(aside(), aside(), -2)};
    return out;
}

// Whether the first of two faces, both hit, is hit strictly before the other.
template <class Scalar>
bool strictly_before(const Stack<Scalar>& stack, std::uint32_t x, std::uint32_t y) {
    const auto corners = [&](std::uint32_t triangle) {
        detail::Corners c;
        for (std::size_t k = 0; k < 3; ++k)
            c[k] = detail::to_point(stack.soup.positions[stack.soup.triangles[triangle][k]]);
        return c;
    };
    return detail::compare_fractions(detail::to_path(stack.segment), corners(x), corners(y)) < 0;
}

// How many hits `all_hits` kept; each is checked.
template <class Scalar>
std::size_t expect_clear(const Stack<Scalar>& stack, const CollisionMesh<Scalar>& mesh, const QueryOptions& options) {
    std::array<Hit<Scalar>, 8> hits;
    std::array<Hit<Scalar>, 8> on_the_way;
    const std::size_t count = mesh.all_hits(stack.segment, hits, options);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t passed = mesh.all_hits({stack.segment.from, hits[i].point}, on_the_way, options);
        for (std::size_t j = 0; j < passed; ++j) {
            bool known = false;
            for (std::size_t k = 0; k < i; ++k)
                known = known || (hits[k].triangle == on_the_way[j].triangle &&
                                  strictly_before(stack, hits[k].triangle, hits[i].triangle));
            EXPECT_TRUE(known) << "hit " << i << " of " << count << ": the way to its point hits triangle "
                               << on_the_way[j].triangle << "; " << to_text(stack.segment) << ", "
                               << to_text(std::optional(hits[i]));
        }
    }
    const auto first = mesh.first_hit(stack.segment, options);
    EXPECT_TRUE(!first || !mesh.any_hit({stack.segment.from, first->point}, options));
    return count;
}

// `accept` refuses exactly one contact: that of the caller's segment with the nearer face.
template <class Scalar>
void nearer_contact_refused() {
    Random random(3);
    int asked = 0;
    for (int i = 0; i < 20'000 && !::testing::Test::HasFailure(); ++i) {
        const Stack<Scalar> two = stack<Scalar>(2, random);
        const CollisionMesh<Scalar> mesh(two.soup.view());
        std::array<Hit<Scalar>, 2> both;
        if (mesh.all_hits(two.segment, both) != 2) continue;
        const std::uint32_t nearer = both[0].triangle;
        Vec3<double> hole;
        const auto look = [&](const Contact& contact) {
            if (contact.triangle == nearer) hole = contact.barycentric;
            return false;
        };
        EXPECT_FALSE(mesh.any_hit(two.segment, {.accept = look}));
        const auto accept = [&](const Contact& contact) {
            return contact.triangle != nearer || contact.barycentric != hole;
        };
        ASSERT_EQ(expect_clear(two, mesh, {.accept = accept}), 1U);
        ++asked;
    }
    EXPECT_GT(asked, 3000);
}

TEST(AcceptAllHits, what_is_refused_is_not_passed) {
    nearer_contact_refused<float>();
    nearer_contact_refused<double>();
}

// `accept` as fickle as it may be: by the last bit of a weight.
template <class Scalar>
void fickle() {
    Random random(5);
    std::size_t hits = 0;
    for (int i = 0; i < 20'000 && !::testing::Test::HasFailure(); ++i) {
        const Stack<Scalar> several = stack<Scalar>(4, random);
        const CollisionMesh<Scalar> mesh(several.soup.view());
        const auto accept = [](const Contact& contact) { return (bits(contact.barycentric[0]) & 1) != 0; };
        hits += expect_clear(several, mesh, {.sides = Sides::both, .accept = accept});
    }
    EXPECT_GT(hits, 5000U);
}

TEST(AcceptAllHits, holds_for_a_fickle_answer) {
    fickle<float>();
    fickle<double>();
}

}  // namespace
}  // namespace pierce::test

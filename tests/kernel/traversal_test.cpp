// The wide kernels skip no cluster whose box a segment comes within the noise of, and visit none twice: against all
// boxes, in rational numbers, for each instruction set. (Records of NaN are never refused, so that boxes alone decide.)
#include <CGAL/Gmpq.h>

#include <cluster/frame.h>
#include <gtest/gtest.h>
#include <kernel/backends.h>
#include <query/broadphase.h>
#include <support/random.h>
#include <tree/make_tree.h>

namespace pierce::test {
namespace {

using namespace detail;
using Q = CGAL::Gmpq;

class Traversal : public ::testing::TestWithParam<const Backend*> {};
INSTANTIATE_TEST_SUITE_P(Each, Traversal, ::testing::ValuesIn(backends()),
                         [](const auto& p) { return std::string(p.param->name); });

/// How boxes lie: all over, on a lattice, or most of them so small and so near to one another that nodes need frames of
/// their own.
enum class Kind { scattered, lattice, uneven };

template <class Scalar>
struct World {
    World(Kind kind, std::size_t count, double offset, double noise, Random& random) : boxes(count) {
        for (std::size_t i = 0; i < count; ++i) {
            boxes[i].ref = cluster_ref(static_cast<std::uint32_t>(i), 1);
            boxes[i].key = 0;
            const bool far = kind == Kind::uneven && i >= 2;
            for (std::size_t k = 0; k < 3; ++k) {
                const double size = far ? 1e-5 : kind == Kind::uneven ? 0.4 : 0.1;
                double low = far ? 0.3 + 1e-3 * random.unit() : 0.5 * random.unit();
                double high = low + size * random.unit();
                if (kind == Kind::lattice) {
                    low = random.between_ints(0, 8) / 16.0;
                    high = low + random.between_ints(0, 3) / 16.0;
                }
                boxes[i].low[k] = static_cast<Scalar>(low + offset);
                boxes[i].high[k] = static_cast<Scalar>(high + offset);
            }
        }
        ClusterBuild<Scalar> build;
        for (std::size_t k = 0; k < 3; ++k) {
            build.low[k] = build.high[k] = static_cast<double>(boxes[0].low[k]);
            for (const auto& box : boxes) {
                build.low[k] = std::min(build.low[k], static_cast<double>(box.low[k]));
                build.high[k] = std::max(build.high[k], static_cast<double>(box.high[k]));
            }
        }
        frame = frame_of(build);
        frame.noise = noise;
        std::vector<ClusterBox<Scalar>> order = boxes;
        tree = make_tree(std::span(order), cluster_ref(static_cast<std::uint32_t>(count), 1), frame, {});
        records.assign(k_row_count * (count + 1) + k_beyond_records, std::numeric_limits<Scalar>::quiet_NaN());
    }

    std::vector<ClusterBox<Scalar>> boxes;
    Frame frame;
    Tree tree;
    std::vector<Scalar> records;
};

/// Whether the segment comes within the noise of the box, and where first: clipping in rational numbers, behind a
/// generous look in double.
template <class Scalar>
bool touches(const Path& path, const ClusterBox<Scalar>& box, double noise, Q& enter) {
    for (std::size_t k = 0; k < 3; ++k) {
        const double slack = noise + 1e-9 * (1 + std::abs(path.from[k]) + std::abs(path.to[k]));
        if (std::min(path.from[k], path.to[k]) - slack > box.high[k]) return false;
        if (std::max(path.from[k], path.to[k]) + slack < box.low[k]) return false;
    }
    enter = 0;
    Q leave = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const Q low = Q(static_cast<double>(box.low[k])) - Q(noise) - Q(path.from[k]);
        const Q high = Q(static_cast<double>(box.high[k])) + Q(noise) - Q(path.from[k]);
        const Q d = Q(path.to[k]) - Q(path.from[k]);
        if (d == 0) {
            if (low > 0 || high < 0) return false;
            continue;
        }
        enter = std::max(enter, std::min(Q(low / d), Q(high / d)));
        leave = std::min(leave, std::max(Q(low / d), Q(high / d)));
        if (enter > leave) return false;
    }
    return true;
}

template <class Scalar>
Path path_for(const World<Scalar>& world, Random& random) {
    const ClusterBox<Scalar>& box = world.boxes[random.below(world.boxes.size())];
    const std::size_t how = random.below(6);
    const double sizes[] = {1e-6, 0.01, 0.3, 2, 50, 1e6};
    const double size = sizes[random.below(6)];
    Path path{};
    const Vec3<double> d = size * random.direction();
    for (std::size_t k = 0; k < 3; ++k) {
        const bool high = random.chance(0.5);
        const double corner = static_cast<double>(high ? box.high[k] : box.low[k]);
        const double apart = random.chance(0.5) ? 0 : high ? world.frame.noise : -world.frame.noise;
        double along = d[static_cast<Eigen::Index>(k)];
        if (how == 0 && random.chance(0.5)) along = 0;  // in a plane, or along an axis
        if (how == 1) along = std::round(along * 16) / 16;
        // Through a corner of the noise around the box, up to it, or past it.
        path.from[k] = corner + apart - along;
        path.to[k] = corner + apart + (how == 2 ? 0 : how == 3 ? 1e-3 * along : along);
        if (how == 4) path.from[k] = world.frame.low[k] + random.unit();
    }
    return path;
}

std::string text(const Path& path) {
    char all[200];
    std::snprintf(all, sizeof all, "%a %a %a -> %a %a %a", path.from[0], path.from[1], path.from[2], path.to[0],
                  path.to[1], path.to[2]);
    return all;
}

template <class Scalar>
struct Asked {
    std::vector<int> times;
    const Probe<Scalar>* probe;
    const World<Scalar>* world;
    const Path* path;
    float limit;
    bool nearest;
    std::size_t visits = 0;
};

template <class Scalar>
void expect_complete(const ScalarKernels<Scalar>& kernels, const World<Scalar>& world, const Path& path,
                     float short_way, bool nearest, std::size_t& visits, std::size_t& touched) {
    const std::size_t count = world.boxes.size();
    Asked<Scalar> asked{std::vector<int>(count + 1), nullptr, &world, &path, 0, nearest};
    Probe<Scalar> probe;
    if (kernels.set_probe(world.frame, path.from.data(), path.to.data(), path.ray, false, false, short_way, probe)) {
        asked.probe = &probe;
        asked.limit = parameter(probe, 1);
        // As a first hit would be looked for: where the box is met nothing behind it counts any more.
        const Visit visit = [](void* self, std::uint32_t cluster, unsigned lanes) {
            auto& a = *static_cast<Asked<Scalar>*>(self);
            EXPECT_EQ(lanes, 1U);
            ++a.times[first_of(cluster)];
            ++a.visits;
            Q enter;
            const std::size_t i = first_of(cluster);
            if (a.nearest && i < a.world->boxes.size() &&
                touches(*a.path, a.world->boxes[i], a.world->frame.noise, enter))
                a.limit = std::min(a.limit, parameter(*a.probe, std::nextafter(CGAL::to_double(enter), 2)));
            return a.limit;
        };
        kernels.traverse(world.tree.view(), world.records.data(), probe, asked.limit, visit, &asked);
        EXPECT_EQ(probe.clusters, asked.visits);
    }
    visits += asked.visits;
    for (std::size_t i = 0; i < count; ++i) {
        Q enter;
        ASSERT_LE(asked.times[i], 1) << text(path);
        if (!touches(path, world.boxes[i], world.frame.noise, enter)) continue;
        ++touched;
        if (nearest && parameter(*asked.probe, CGAL::to_double(enter) * (1 - 0x1p-52)) > asked.limit) continue;
        ASSERT_EQ(asked.times[i], 1) << "box " << i << ": " << text(path);
    }
}

template <class Scalar>
void expect_complete(const Backend& backend, std::uint64_t seed) {
    Random random(seed);
    std::size_t visits = 0;
    std::size_t touched = 0;
    std::size_t of_boxes = 0;
    std::size_t touched_by_boxes = 0;
    int coarse = 0;
    for (int round = 0; round < 40; ++round) {
        const auto kind = static_cast<Kind>(random.below(3));
        const double offset = random.chance(0.7) ? 0 : random.chance(0.5) ? -0.7 : 1000;
        const double noises[] = {0x1p-1022, 0x1p-1022, 1e-12, 1e-6, 0.01};
        const World<Scalar> world(kind, 2 + random.below(200), offset, noises[random.below(5)], random);
        coarse += world.tree.coarse ? 1 : 0;
        for (int i = 0; i < 100; ++i) {
            const Path path = path_for(world, random);
            const float short_way = world.tree.short_way;
            expect_complete(backend.of<Scalar>(), world, path, short_way, i % 4 == 0, visits, touched);
            // Any other goes by its box as well.
            if (!world.tree.coarse)
                expect_complete(backend.of<Scalar>(), world, path, std::numeric_limits<float>::infinity(), i % 4 == 1,
                                of_boxes, touched_by_boxes);
            if (testing::Test::HasFatalFailure()) return;
        }
    }
    EXPECT_GT(coarse, 5);
    EXPECT_GT(touched, 5000U);
    EXPECT_LT(visits, touched * 2) << "margins cost visits";
    EXPECT_GT(touched_by_boxes, 4000U);
    EXPECT_LT(of_boxes, touched_by_boxes * 12);
}

TEST_P(Traversal, skips_nothing_and_visits_nothing_twice) {
    expect_complete<float>(*GetParam(), 1);
    expect_complete<double>(*GetParam(), 2);
}

}  // namespace
}  // namespace pierce::test

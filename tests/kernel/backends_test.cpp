// The wide kernels: culling is a comparison byte by byte, and no triangle is refused that exact arithmetic says is hit; five million
// decisions of each kernel, and a hundred million in the slow run. Whichever works, the answers are the same.
#include <atomic>
#include <thread>

#include <gtest/gtest.h>
#include <exact/decide.h>
#include <kernel/backends.h>
#include <kernel/filter.h>
#include <pierce/collision_mesh.h>
#include <query/search.h>
#include <support/gmp_oracle.h>
#include <support/hash.h>
#include <support/meshes.h>
#include <support/pairs.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

using namespace detail;

class Backends : public ::testing::TestWithParam<const Backend*> {};
class BackendsSoak : public Backends {};
INSTANTIATE_TEST_SUITE_P(Each, Backends, ::testing::ValuesIn(backends()), [](const auto& p) { return std::string(p.param->name); });
INSTANTIATE_TEST_SUITE_P(Each, BackendsSoak, ::testing::ValuesIn(backends()), [](const auto& p) { return std::string(p.param->name); });

constexpr std::uint32_t k_untouched = 0xdead'beef;

TEST_P(Backends, cull_compares_byte_by_byte) {
    Random random(1);
    const auto byte_of = [](std::uint64_t x, int place) { return static_cast<signed char>(x >> place & 0xff); };
    const auto random_bytes = [&](int low, int high) {
        std::uint64_t x = 0;
        for (int place = 0; place < 64; place += 8) x |= (static_cast<std::uint64_t>(random.between_ints(low, high)) & 0xff) << place;
        return x;
    };
    std::size_t left = 0;
    std::size_t asked = 0;
    for (int round = 0; round < 3000; ++round)
        for (const unsigned count : {0U, 1U, 2U, 3U, 4U, 5U, 8U, 31U, 32U, 33U, 63U, 64U, 65U, 127U, 128U}) {
            // A few values, so that bytes are often equal; all values; or what leaves nearly everything.
            const int reach = round % 3 == 0 ? 2 : 128;
            const std::uint64_t above = round % 3 == 2 ? random_bytes(100, 127) : random_bytes(-reach, reach - 1);
            const std::uint64_t seen = random.chance(0.5) ? 0 : (std::uint64_t{1} << random.below(3)) << (random.chance(0.5) ? 24 : 56);
            std::vector<std::uint64_t> boxes;  // as many more as may be read, which would be left
            while (boxes.size() < count) boxes.push_back(random_bytes(-reach, reach - 1));
            boxes.insert(boxes.end(), 7, 0x8080808080808080);
            std::vector<std::uint32_t> ids;
            std::vector<std::uint32_t> expected;
            for (unsigned i = 0; i < count; ++i) {
                ids.push_back(static_cast<std::uint32_t>(random.below(0xffffffff)));
                bool leave = (boxes[i] & seen) == 0;
                for (int place = 0; place < 64; place += 8) leave = leave && byte_of(boxes[i], place) <= byte_of(above, place);
                if (leave) expected.push_back(ids.back());
            }
            ids.insert(ids.end(), 7, 0);
            std::vector<std::uint32_t> out(count + 9, k_untouched);
            const unsigned found = GetParam()->cull(boxes.data(), ids.data(), count, above, seen, out.data());
            ASSERT_EQ(out.back(), k_untouched);
            ASSERT_EQ(std::vector<std::uint32_t>(out.begin(), out.begin() + found), expected) << "of " << count;
            left += found;
            asked += count;
        }
    EXPECT_GT(left, asked / 20);
    EXPECT_LT(left, asked * 19 / 20);
}

struct Tally {
    std::atomic<std::int64_t> decisions = 0;
    std::atomic<std::int64_t> hits = 0;
    std::atomic<std::int64_t> refused = 0;
    std::atomic<std::int64_t> refused_moved = 0;
    std::atomic<std::int64_t> wrong = 0;
};

/// One triangle in its six turns, each of which rounds in its own way; a list of some of them, so that lanes are full or not.
template <class Scalar>
class Judge {
  public:
    Judge(const Backend& backend, std::uint64_t seed, Tally& tally) : backend_(backend), random_(seed), tally_(tally) {}

    void judge(Family family, int power, double offset) {
        pair_ = make_pair_of<Scalar>(family, 1, offset, random_);
        for (Point* p : {&pair_.path.from, &pair_.path.to, &pair_.corners[0], &pair_.corners[1], &pair_.corners[2]})
            for (double& x : *p) x = rounded(std::ldexp(x, power));
        // Some power of two near the size of the triangle, as the grid chooses it, or any.
        const int size = random_.chance(0.9) ? power + random_.between_ints(-4, 8) : random_.between_ints(-100, 100);
        scene_.scale = static_cast<float>(std::ldexp(1.0, std::clamp(-size, -100, 100)));
        constexpr std::array<std::array<std::size_t, 3>, 6> turns = {{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
        scene_.coordinates = RawArray<Scalar>(9 * turns.size() + 1);
        Scalar* next = scene_.coordinates.data();
        for (const auto& turn : turns)
            for (const std::size_t corner : turn)
                for (const double x : pair_.corners[corner]) *next++ = static_cast<Scalar>(x);
        *next = 0;

        const Point from = pair_.path.from;
        const Point to = pair_.path.to;
        Path longer{from, to};
        const double factor = std::exp(random_.between(0, 12));
        for (std::size_t k = 0; k < 3; ++k) {
            longer.to[k] = rounded(to[k] + factor * random_.unit() * (to[k] - from[k]));
            longer.from[k] = rounded(from[k] - factor * (to[k] - from[k]));
        }
        for (const Path& path : {Path{from, to}, Path{to, from}, Path{from, pair_.corners[random_.below(3)]},
                                 Path{pair_.corners[random_.below(3)], to}, longer})
            judge(path);
    }

  private:
    // As queries do: the segment's start first, then for a long one the places where it enters cells.
    void judge(const Path& path) {
        pair_.path = path;
        const int truth = true_side();
        const Sides sides = std::array{Sides::front, Sides::back, Sides::both}[random_.below(3)];
        Search<Scalar> search(scene_, path, sides);
        refine(search, sides, truth, tally_.refused);
        search.move_to(random_.chance(0.2) ? static_cast<double>(random_.below(2)) : random_.unit());
        refine(search, sides, truth, tally_.refused_moved);
    }

    void refine(Search<Scalar>& search, Sides sides, int truth, std::atomic<std::int64_t>& refused) {
        std::array<std::uint32_t, 18 + 8> ids{};
        std::array<std::uint32_t, 18 + 1> out{};
        const auto count = static_cast<unsigned>(random_.below(18));
        for (unsigned i = 0; i < count; ++i) ids[i] = static_cast<std::uint32_t>(random_.below(6));
        out[count] = k_untouched;
        const unsigned found = backend_.refine(search.probe(0x1p-24F), scene_.coordinates.data(), ids.data(), count, out.data());
        bool wrong = out[count] != k_untouched || found > count;
        std::int64_t hits = 0;
        unsigned next = 0;  // what is left is in order: the refused are those that it skips
        for (unsigned i = 0; i < count; ++i) {
            const int side = ids[i] < 3 ? truth : -truth;
            const bool hit = side > 0 ? sides != Sides::back : side < 0 && sides != Sides::front;
            hits += hit ? 1 : 0;
            if (next < found && out[next] == ids[i]) ++next;
            else wrong = wrong || hit;
        }
        wrong = wrong || next != found;
        wrong = wrong || (search.probe(0x1p-24F).ends != 0 && refine_many(search.probe(0x1p-24F), ids, count, sides, truth));
        tally_.decisions += count;
        tally_.hits += hits;
        refused += count - found;
        if (!wrong) return;
        ++tally_.wrong;
        ADD_FAILURE() << "sides " << int(sides) << " scale " << scene_.scale << " noise " << search.probe(0x1p-24F).ray.direction[3] << ": " << describe(pair_);
    }

    /// Each triangle with a ray of its own, the true one or one that is something else; whether a hit of the former is refused.
    bool refine_many(const Probe<Scalar>& probe, std::array<std::uint32_t, 18 + 8> ids, unsigned count, Sides sides, int truth) {
        std::array<Ray<Scalar>, 3> rays = {probe.ray, probe.ray, probe.ray};
        for (std::size_t k = 0; k < 3; ++k) rays[0].direction[k] = -rays[0].direction[k];
        rays[2].origin[random_.below(3)] += static_cast<Scalar>(random_.between(-1, 1));
        std::array<std::uint32_t, 18 + 8> queries{};
        for (unsigned i = 0; i < count; ++i) queries[i] = static_cast<std::uint32_t>(random_.below(3));
        std::array<std::uint32_t, 18 + 1> out{};
        out[count] = k_untouched;
        const unsigned found = backend_.of<Scalar>().refine_many(probe, rays.data(), scene_.coordinates.data(), ids.data(), queries.data(), count, out.data());
        if (out[count] != k_untouched || found > count) return true;
        unsigned next = 0;
        for (unsigned i = 0; i < count; ++i) {
            const int side = ids[i] < 3 ? truth : -truth;
            const bool hit = side > 0 ? sides != Sides::back : side < 0 && sides != Sides::front;
            if (next < found && out[next] == i) ++next;
            else if (hit && queries[i] == 1) return true;
        }
        return next != found;
    }

    int true_side() {
        const Filtered filtered = filter(pair_.corners, pair_.path, Sides::both);
        bool hit = filtered.verdict == Verdict::hit;
        Sides side = filtered.side;
        if (filtered.verdict == Verdict::doubtful) {
            const Decision decision = decide(pair_.path, pair_.corners, Sides::both);
            hit = decision.hit;
            side = decision.side;
        }
        const int truth = hit ? (side == Sides::front ? 1 : -1) : 0;
        if (random_.chance(0.02) && truth != oracle_.hit_side(pair_.path, pair_.corners)) {
            ++tally_.wrong;
            ADD_FAILURE() << "the judge: " << describe(pair_);
        }
        return truth;
    }

    static double rounded(double x) {
        constexpr auto most = static_cast<double>(std::numeric_limits<Scalar>::max());
        return static_cast<double>(static_cast<Scalar>(std::clamp(x, -most, most)));
    }

    const Backend& backend_;
    Random random_;
    Tally& tally_;
    GmpOracle oracle_;
    Scene<Scalar> scene_;
    Pair pair_{};
};

template <class Scalar>
void refuse(const Backend& backend, std::int64_t decisions, int lowest_power, int highest_power) {
    Tally tally;
    const auto work = [&](std::uint64_t seed) {
        Random random(seed);
        Judge<Scalar> judge(backend, ~seed, tally);
        while (tally.wrong == 0 && tally.decisions < decisions) {
            const auto family = static_cast<Family>(random.below(k_family_names.size()));
            int power = random.between_ints(-20, 20);
            const double kind = random.unit();
            if (kind < 0.1) power = random.between_ints(lowest_power, lowest_power + 60);
            else if (kind < 0.2) power = random.between_ints(highest_power - 30, highest_power);
            judge.judge(family, power, random.chance(0.6) ? 0 : random.chance(0.5) ? 1e2 : 1e6);
        }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) threads.emplace_back(work, 1000 + i);
    for (std::thread& thread : threads) thread.join();
    std::cout << tally.decisions << " decisions, " << tally.hits << " hits, " << tally.refused << " refused from the start, "
              << tally.refused_moved << " from further on\n";
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_GT(tally.hits, tally.decisions / 20);
    EXPECT_GT(tally.refused, tally.decisions / 10);  // a kernel that refuses nothing would be right as well
    EXPECT_GT(tally.refused_moved, tally.decisions / 15);
}

void refuse_both(const Backend& backend, std::int64_t each) {
    refuse<float>(backend, each, -149, 106);
    refuse<double>(backend, each, -1074, 1002);
}

TEST_P(Backends, refine_refuses_no_hit_in_five_million) { refuse_both(*GetParam(), 2'500'000); }
TEST_P(BackendsSoak, refine_refuses_no_hit_in_a_hundred_million) { refuse_both(*GetParam(), 50'000'000); }

template <class Scalar>
std::uint64_t answers(const std::string& backend, const TriangleSoup<Scalar>& soup) {
    const CollisionMesh<Scalar> mesh(soup.view(), {.backend = backend});
    EXPECT_EQ(mesh.statistics().backend, backend);
    const Extent<Scalar> extent(soup.view());
    Random random(17);
    Hash hash;
    std::array<Hit<Scalar>, 4> hits;
    for (int i = 0; i < 5000; ++i) {
        const Segment<Scalar> segment = mixed_segment(soup.view(), extent, random);
        const std::size_t total = mesh.all_hits(segment, hits, {.sides = Sides::both});
        hash.add(total);
        for (std::size_t k = 0; k < std::min(total, hits.size()); ++k) hash.add(hits[k]);
        if (const auto hit = mesh.first_hit(segment)) hash.add(*hit);
        hash.add(static_cast<std::uint64_t>(mesh.crossings(segment)));
    }
    return hash.value();
}

TEST_P(Backends, give_the_same_answers) {
    const std::string name = GetParam()->name;
    const Vec3<double> far(1e3, -1e3, 1e3);
    const auto lattice = moved<float>(polycube(4, 0.5, 2, 1), 0.1, far);
    const auto hills = moved<double>(terrain(40, 0.1, 3), 1e-3, far);
    const auto splinters = moved<float>(shards(500, 1), 1, Vec3<double>::Zero());
    EXPECT_EQ(answers(name, lattice), answers("plain", lattice));
    EXPECT_EQ(answers(name, hills), answers("plain", hills));
    EXPECT_EQ(answers(name, splinters), answers("plain", splinters));
}

}  // namespace
}  // namespace pierce::test

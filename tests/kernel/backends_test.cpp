// The wide kernels refuse no triangle that exact arithmetic says is hit, be it by the segment or by a way to a point as
// near to it as place.h looks: five million decisions of each kernel, and a hundred million in the slow run. Whichever
// kernels work, the answers are the same.
#include <atomic>
#include <thread>

#include <cluster/frame.h>
#include <cluster/morton_key.h>
#include <exact/fraction.h>
#include <gtest/gtest.h>
#include <kernel/backends.h>
#include <kernel/filter.h>
#include <pierce/collision_mesh.h>
#include <query/broadphase.h>
#include <query/place.h>
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
const auto k_name = [](const auto& p) { return std::string(p.param->name); };
INSTANTIATE_TEST_SUITE_P(Each, Backends, ::testing::ValuesIn(backends()), k_name);
INSTANTIATE_TEST_SUITE_P(Each, BackendsSoak, ::testing::ValuesIn(backends()), k_name);

struct Tally {
    std::atomic<std::int64_t> decisions = 0;
    std::atomic<std::int64_t> hits = 0;
    std::atomic<std::int64_t> refused = 0;
    std::atomic<std::int64_t> way_hits = 0;
    std::atomic<std::int64_t> new_way_hits = 0;  ///< by ways beside a segment that hits nothing
    std::atomic<std::int64_t> wrong = 0;
};

constexpr std::array<std::array<std::size_t, 3>, 6> k_turns = {
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

/// A cluster of one triangle in some of its six turns, each of which rounds in its own way, in a scene of its own.
template <class Scalar>
class Judge {
  public:
    Judge(const Backend& backend, std::uint64_t seed, Tally& tally)
        : kernels_(backend.of<Scalar>()), random_(seed), tally_(tally) {}

    void judge(Family family, int power, double offset) {
        pair_ = make_pair_of<Scalar>(family, 1, offset, random_);
        for (Point* p : {&pair_.path.from, &pair_.path.to, &pair_.corners[0], &pair_.corners[1], &pair_.corners[2]})
            for (double& x : *p) x = rounded(std::ldexp(x, power));
        if (has_zero_area(pair_.corners)) return;  // those are in no cluster
        write_record();
        set_scene();

        const Point from = pair_.path.from;
        const Point to = pair_.path.to;
        Path longer{from, to};
        const double factor = std::exp(random_.between(0, random_.chance(0.1) ? 80 : 12));
        for (std::size_t k = 0; k < 3; ++k) {
            longer.to[k] = rounded(to[k] + factor * random_.unit() * (to[k] - from[k]));
            longer.from[k] = rounded(from[k] - factor * (to[k] - from[k]));
        }
        for (const Path& path : {Path{from, to}, Path{to, from}, Path{from, pair_.corners[random_.below(3)]},
                                 Path{pair_.corners[random_.below(3)], to}, longer, Path{from, longer.to}})
            judge(path, std::array{Sides::front, Sides::back, Sides::both}[random_.below(3)]);
    }

  private:
    void write_record() {
        count_ = 1 + static_cast<unsigned>(random_.below(8));
        cluster_ = cluster_ref(static_cast<std::uint32_t>(random_.below(3)), count_);
        records_.assign(k_row_count * (first_of(cluster_) + count_) + k_beyond_records, Scalar(0));
        Scalar* record = records_.data() + k_row_count * first_of(cluster_);
        for (unsigned lane = 0; lane < count_; ++lane) {
            turns_[lane] = random_.below(6);
            for (std::size_t r = 0; r < 9; ++r)
                record[r * count_ + lane] = static_cast<Scalar>(pair_.corners[k_turns[turns_[lane]][r / 3]][r % 3]);
        }
    }

    // As make_scene does it, for a scene that is as large as the triangle or larger.
    void set_scene() {
        const Box box = box_of(pair_.corners);
        ClusterBuild<Scalar> build;
        Scalar half = 0;
        // A triangle that is tiny in its scene has volumes near the least numbers also in double.
        const double more = random_.chance(0.5) ? 0 : std::exp(random_.between(-5, random_.chance(0.3) ? 40 : 8));
        largest_ = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double extent = box.high[k] * 0.5 - box.low[k] * 0.5;
            build.low[k] = rounded(box.low[k] - more * random_.unit() * extent);
            build.high[k] = rounded(box.high[k] + more * random_.unit() * extent);
            half = std::max(half, static_cast<Scalar>(build.high[k] * 0.5 - build.low[k] * 0.5));
            largest_ = std::max({largest_, std::abs(build.low[k]), std::abs(build.high[k])});
        }
        if (half == 0) half = std::numeric_limits<Scalar>::denorm_min();
        build.unit = half < 1 ? static_cast<double>(power_to_reach(-2, half)) : std::ldexp(1.0, -2 - std::ilogb(half));
        frame_ = frame_of(build);
        near_ = near_margin(grain_of<Scalar>(largest_));
        frame_.noise = std::max(near_ * frame_.unit, std::numeric_limits<double>::min());
    }

    void judge(const Path& path, Sides sides) {
        pair_.path = path;
        const unsigned hits = hits_of(path, sides);
        tally_.decisions += count_;
        tally_.hits += std::popcount(hits);
        const unsigned all = left(path, sides, 1);
        tally_.refused += count_ - static_cast<unsigned>(std::popcount(all));
        expect(hits & ~all, path, sides, 1);
        if (hits != 0) {
            const double fraction = measure(path, pair_.corners).fraction;
            const double limit = std::min(1.0, fraction * (1 + 0x1p-52) + 0x1p-1072);
            expect(hits & ~left(path, sides, limit), path, sides, limit);
        }
        judge_way(path, sides, hits);
    }

    // The error of t * (to - from) + from is below 3 units, and rounding takes another half; 8 more are 11.5 of the 12
    // that a place may be away (place.h).
    void judge_way(const Path& path, Sides sides, unsigned hits) {
        static_assert(near_margin(k_grain_units) == 12);
        const double t = random_.chance(0.5) ? 1 : random_.unit();
        const double unit = last_place<Scalar>(largest_);
        Path way{path.from, path.to};
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::abs(path.from[k]) > largest_ || std::abs(path.to[k]) > largest_) return;
            if (std::isinf(path.to[k] - path.from[k])) return;
            way.to[k] = rounded(path.from[k] + t * (path.to[k] - path.from[k]) + 8 * unit * random_.between(-1, 1));
        }
        const unsigned on_way = hits_of(way, sides);
        tally_.way_hits += std::popcount(on_way);
        tally_.new_way_hits += std::popcount(on_way & ~hits);
        if (on_way != 0) expect(on_way & ~left(path, sides, t), path, sides, t);
    }

    /// What the kernels leave up to a fraction of the segment.
    unsigned left(const Path& path, Sides sides, double fraction) {
        Probe<Scalar> probe;
        if (!kernels_.set_probe(frame_, path.from.data(), path.to.data(), path.ray, sides == Sides::front,
                                sides == Sides::back, 0, probe))
            return 0;
        const float limit = parameter(probe, fraction);
        return limit < 0 ? 0 : kernels_.test_cluster(probe, records_.data(), cluster_, limit);
    }

    /// A bit for each triangle of the cluster that is hit.
    unsigned hits_of(const Path& path, Sides sides) {
        const bool one_way = is_hit(path, pair_.corners, sides);
        const bool other_way = is_hit(path, {pair_.corners[0], pair_.corners[2], pair_.corners[1]}, sides);
        unsigned bits = 0;
        for (unsigned lane = 0; lane < count_; ++lane)
            if (turns_[lane] < 3 ? one_way : other_way) bits |= 1U << lane;
        return bits;
    }

    bool is_hit(const Path& path, const Corners& corners, Sides sides) {
        Measured measured;
        measure_path<double>(corners, path, measured);
        const Filtered filtered = filter(measured, sides);
        bool hit = filtered.verdict == Verdict::hit;
        if (filtered.verdict == Verdict::doubtful) hit = decide(path, corners, sides).hit;
        if (sides == Sides::both && random_.chance(0.02) && hit != (oracle_.hit_side(path, corners) != 0)) {
            ++tally_.wrong;
            ADD_FAILURE() << "the judge: " << describe(pair_);
        }
        return hit;
    }

    void expect(unsigned refused, const Path& path, Sides sides, double limit) {
        if (refused == 0) return;
        ++tally_.wrong;
        ADD_FAILURE() << "sides " << int(sides) << " limit " << limit << " unit " << frame_.unit << " noise "
                      << frame_.noise << " of " << count_ << " refused: " << refused << ": "
                      << describe({path, pair_.corners});
    }

    static double rounded(double x) {
        constexpr auto most = static_cast<double>(std::numeric_limits<Scalar>::max());
        return static_cast<double>(static_cast<Scalar>(std::clamp(x, -most, most)));
    }

    const ScalarKernels<Scalar>& kernels_;
    Random random_;
    Tally& tally_;
    GmpOracle oracle_;
    Pair pair_{};
    std::vector<Scalar> records_;
    ClusterRef cluster_ = 0;
    unsigned count_ = 0;
    std::array<std::size_t, 8> turns_{};
    Frame frame_;
    double largest_ = 0;
    double near_ = 0;
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
            if (kind < 0.1)
                power = random.between_ints(lowest_power, lowest_power + 60);
            else if (kind < 0.2)
                power = random.between_ints(highest_power - 30, highest_power);
            else if (kind < 0.3)
                power = random.between_ints(-60, -30);  // floats' volumes underflow, not lengths
            judge.judge(family, power, random.chance(0.6) ? 0 : random.chance(0.5) ? 1e2 : 1e6);
        }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i)
        threads.emplace_back(work, 1000 + i);
    for (std::thread& thread : threads) thread.join();
    std::cout << tally.decisions << " decisions, " << tally.hits << " hits, " << tally.refused << " refused; "
              << tally.way_hits << " hits of ways, " << tally.new_way_hits << " beside a segment that has none\n";
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_GT(tally.hits, tally.decisions / 20);
    EXPECT_GT(tally.refused, tally.decisions / 10);  // a kernel that refuses nothing would be right as well
    EXPECT_GT(tally.new_way_hits, tally.decisions / 1000);
}

// The powers of two leave room for offsets of 1e6 below the largest numbers.
void refuse_both(const Backend& backend, std::int64_t each) {
    refuse<float>(backend, each, -149, 106);
    refuse<double>(backend, each, -1074, 1002);
}

TEST_P(Backends, refuse_no_hit_in_five_million) { refuse_both(*GetParam(), 2'500'000); }
TEST_P(BackendsSoak, refuse_no_hit_in_a_hundred_million) { refuse_both(*GetParam(), 50'000'000); }

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

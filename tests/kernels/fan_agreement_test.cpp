// Real fans against the exact kernel over their triangles: they differ only where the pair lies within the fan's error
// of a boundary of the decision, and values are right within the same error.
//
// The error. u is the unit of rounding (2^-24, 2^-53). Of a point or vector p, let x_j be its coordinates in the basis
// B_j = (AB, AC, N) of triangle j, x_0 = first map, x_j = M_j x_{j-1}. What step j commits, d_j, is handed on exactly,
// by the true change of basis B_k^-1 B_j:
//   error of x_k = sum over j <= k of |B_k^-1 B_j| d_j
// The first map's rows r come from cross products over N.N. N is off by a few u |AB| |AC|, that is, with
// A = |AB| |AC| / |N|, one over the sine of the angle at the apex, by a few u A of its length. A row is off by as much
// of its length: d_0 = K u A |r| s, where s = |p| + |apex| for the start and |p| for the way back, which has no offset.
// The six numbers of a turn are triple products over N.N. With sizes in place of products, X = AB and Z = AD, the
// largest that they can be is
//   |a| <= |X| |Z| / |N|       |b| <= |AC| |X| / |N|       |c| <= |X| / |N|
//   |d| <= |N_old| |Z| / |N|   |e| <= |AC| |N_old| / |N|   |f| <= |N_old| / |N|
// they are off by a few u A of that, and the sum of their products with x_{j-1} has an error of a few u of the same:
//   d_j = K u A_j C_j |x_{j-1}|, where C_j are these bounds, and 1 where v is added as it is.
// The line meets the plane at t = w / b of the start's w and the way's b: off by (dw + t db) / |b| + u.
// u = u_start - t u_back is then off by du_start + t du_back + |u_back| dt, and u of the coordinates' own size. K
// counts the roundings in the longest chain of a step: 1 for an edge, 2 for a cross product, twice, 3 for a product of
// vectors, 3 for N.N and the division, 4 for the sum, a fraction and three more where the last triangle is judged by z:
// about 20, were all of one sign and size. The test is run with 8; the largest that was seen is half of it (0.50;
// compilers draw other samples).
#include <cstdio>
#include <limits>
#include <map>

#include <gtest/gtest.h>

#include <kernels/all_kernels.h>
#include <pierce/fans.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

using D = Vec3<double>;
using V = Eigen::Matrix<long double, 3, 1>;
using M = Eigen::Matrix<long double, 3, 3>;

constexpr long double k_fan_roundings = 8;

template <class Scalar>
struct RealFan {
    Vec3<Scalar> apex;
    std::vector<Vec3<Scalar>> ring;
    kernels::TriangleFan::Stored<Scalar> stored;

    [[nodiscard]] std::array<Vec3<Scalar>, 3> triangle(std::size_t k) const { return {apex, ring[k], ring[k + 1]}; }
};

/// A fan and a line: coordinates, and what they may be off by, in the basis of each triangle in turn.
template <class Scalar>
class Bands {
  public:
    Bands(const RealFan<Scalar>& fan, const Vec3<Scalar>& p, const Vec3<Scalar>& q) : fan_(fan) {
        const V apex = fan.apex.template cast<long double>();
        from_ = p.template cast<long double>() - apex;
        back_ = p.template cast<long double>() - q.template cast<long double>();
        far_start_ = p.template cast<long double>().norm() + apex.norm();
        far_back_ = back_.norm();
    }

    /// Of triangle k: how far inside the line is by each condition, in bands, the least of them; fraction, u, v, and
    /// what these may be off by.
    struct At {
        long double inside, fraction, u, v, fraction_band, u_band, v_band;
    };
    At at(std::size_t k) {
        while (basis_.size() <= k) extend();
        const M to_k = basis_[k].inverse();
        V start_error = V::Zero();
        V back_error = V::Zero();
        for (std::size_t j = 0; j <= k; ++j) {
            const M on = (to_k * basis_[j]).cwiseAbs();
            start_error += on * start_made_[j];
            back_error += on * back_made_[j];
        }
        const V start = to_k * from_;
        const V back = to_k * back_;
        const long double t = start[2] / back[2];
        const long double t_band = (start_error[2] + std::abs(t) * back_error[2]) / std::abs(back[2]) + k_unit;
        const V x = start - t * back;
        const V band = start_error + std::abs(t) * back_error + t_band * back.cwiseAbs() + k_unit * start.cwiseAbs();
        const long double end_band = start_error[2] + back_error[2];
        const long double inside = std::min({start[2] / start_error[2], (back[2] - start[2]) / end_band, x[0] / band[0],
                                             x[1] / band[1], (1 - x[0] - x[1]) / (band[0] + band[1])});
        return {inside, t, x[0], x[1], t_band, band[0], band[1]};
    }

  private:
    static constexpr long double k_unit = std::numeric_limits<Scalar>::epsilon() / 2;

    void extend() {
        const std::size_t k = basis_.size();
        const V ac = fan_.ring[k].template cast<long double>() - fan_.apex.template cast<long double>();
        const V ad = fan_.ring[k + 1].template cast<long double>() - fan_.apex.template cast<long double>();
        const V n = ac.cross(ad);
        M basis;
        basis << ac, ad, n;
        const long double size = n.norm();
        const long double unit = k_fan_roundings * k_unit * ac.norm() * ad.norm() / size;
        if (k == 0) {
            const V rows = basis.inverse().rowwise().norm();
            start_made_.push_back(unit * far_start_ * rows);
            back_made_.push_back(unit * far_back_ * rows);
        } else {
            const long double x = basis_.back().col(0).norm();
            const long double y = ac.norm();
            const long double z = ad.norm();
            const long double old = basis_.back().col(2).norm();
            M c;
            c << x * z, size, old * z, y * x, 0, y * old, x, 0, old;
            const M to_old = basis_.back().inverse();
            start_made_.push_back(unit / size * c * (to_old * from_).cwiseAbs());
            back_made_.push_back(unit / size * c * (to_old * back_).cwiseAbs());
        }
        basis_.push_back(basis);
    }

    const RealFan<Scalar>& fan_;
    V from_, back_;
    long double far_start_, far_back_;
    std::vector<M> basis_;
    std::vector<V> start_made_, back_made_;
};

struct FanTally {
    std::int64_t pairs = 0;
    std::int64_t hits = 0;
    std::int64_t different = 0;
    std::int64_t triangles = 0;
    long double largest = 0;  // the largest error of a decision or a value, of the band it is allowed
};

/// What of its bands the answer needs. The triangle that it names must be hit, its values right, and no other hit
/// clearly and clearly earlier.
template <class Scalar>
void judge(const RealFan<Scalar>& fan, const Vec3<Scalar>& from, const Vec3<Scalar>& to, FanTally& tally) {
    const auto answer = kernels::triangle_fan.test(fan.stored, from, to);
    Bands<Scalar> bands(fan, from, to);
    long double used = 0;
    bool named_is_hit = false;
    bool any = false;
    std::optional<typename Bands<Scalar>::At> named;
    if (answer) named = bands.at(answer->triangle);
    for (std::size_t k = 0; k + 1 < fan.ring.size(); ++k) {
        if (!tested(kernels::exact, fan.triangle(k), from, to)) continue;
        any = true;
        if (answer && answer->triangle == k) {
            named_is_hit = true;
            continue;
        }
        const auto at = bands.at(k);
        const long double later =
            named ? (named->fraction - at.fraction) / (named->fraction_band + at.fraction_band) : at.inside;
        used = std::max(used, std::min(at.inside, later));
    }
    if (answer) {
        EXPECT_TRUE(answer->fraction >= 0 && answer->fraction <= 1 && answer->u >= 0 && answer->v >= 0);
        if (!named_is_hit) used = std::max(used, -named->inside);
        used =
            std::max({used, std::abs(answer->fraction - named->fraction) / named->fraction_band,
                      std::abs(answer->u - named->u) / named->u_band, std::abs(answer->v - named->v) / named->v_band});
    }
    ++tally.pairs;
    tally.triangles += static_cast<std::int64_t>(fan.stored.triangles());
    tally.hits += answer ? 1 : 0;
    tally.different += answer ? !named_is_hit : any;
    tally.largest = std::max(tally.largest, used);
    EXPECT_LE(used, 1) << fan.stored.triangles() << " triangles, answer "
                       << (answer ? static_cast<int>(answer->triangle) : -1);
}

/// Seven in ten from the front at a point of a triangle, a third of these at its edge with the next; the others
/// anywhere.
template <class Scalar>
void pairs_of(const RealFan<Scalar>& fan, double size, int count, Random& random, FanTally& tally) {
    const D apex = fan.apex.template cast<double>();
    for (int i = 0; i < count; ++i) {
        D from = apex + size * random.in_cube();
        D to = apex + size * random.in_cube();
        if (random.chance(0.7)) {
            const std::size_t k = random.below(fan.stored.triangles());
            const D b = fan.ring[k].template cast<double>() - apex;
            const D c = fan.ring[k + 1].template cast<double>() - apex;
            D w = random.weights();
            if (random.chance(1.0 / 3)) w = D(1 - w[2], 0, w[2]);
            const D target = apex + w[1] * b + w[2] * c;
            if (b.cross(c).dot(from - apex) < 0) from = 2 * apex - from;
            to = target + random.between(0, 1) * (target - from);
        }
        judge<Scalar>(fan, from.template cast<Scalar>(), to.template cast<Scalar>(), tally);
    }
}

template <class Scalar>
RealFan<Scalar> prepared(const Vec3<Scalar>& apex, const std::vector<Vec3<Scalar>>& ring) {
    return {apex, ring, kernels::triangle_fan.prepare<Scalar>(apex, ring)};
}

/// 2 to 10 members with ring vertices anywhere beside an axis, in order of their angles: one-rings, closed in half of
/// the cases.
template <class Scalar>
RealFan<Scalar> random_one_ring(double scale, double offset, Random& random) {
    for (;;) {
        const std::size_t n = 2 + random.below(9);
        const bool closed = n > 2 && random.chance(0.5);
        const D apex = random.in_cube() + offset * random.direction();
        const D axis = random.direction();
        const D x = axis.cross(random.direction()).normalized();
        const D y = axis.cross(x);
        const auto placed = [scale](const D& p) -> Vec3<Scalar> { return (scale * p).cast<Scalar>(); };
        std::vector<Vec3<Scalar>> ring;
        for (std::size_t k = 0; k <= n; ++k) {
            const double angle = (static_cast<double>(k) + random.between(-0.4, 0.4)) * 6.283185307179586 /
                                 static_cast<double>(n + (closed ? 0 : 1));
            ring.push_back(placed(apex + random.between(0.3, 1) * (std::cos(angle) * x + std::sin(angle) * y) +
                                  random.between(-0.5, 0.5) * axis));
        }
        if (closed) ring.back() = ring.front();
        bool good = true;
        for (std::size_t k = 0; k < n; ++k)
            good = good && kernels::TriangleFan::has_basis<Scalar>(placed(apex), ring[k], ring[k + 1]);
        if (good) return prepared<Scalar>(placed(apex), ring);
    }
}

void report(const char* type, const char* where, const FanTally& tally) {
    const auto pairs = static_cast<double>(tally.pairs);
    std::printf("%-6s %-8s %lld pairs of %.1f triangles, %lld hits, %lld different, largest error %.3Lf of the band\n",
                type, where, static_cast<long long>(tally.pairs), static_cast<double>(tally.triangles) / pairs,
                static_cast<long long>(tally.hits), static_cast<long long>(tally.different), tally.largest);
    EXPECT_GT(tally.hits, tally.pairs / 3);
    EXPECT_GT(tally.largest, 1e-3L) << "the band is so wide that nothing could fail";
    EXPECT_LT(tally.largest, 0.75L) << "not what the comment says";
}

template <class Scalar>
void run() {
    const char* type = sizeof(Scalar) == 4 ? "float" : "double";
    struct Placement {
        const char* name;
        double scale;
        double offset;
    };
    Random random(1);
    std::int64_t pairs = 0;
    for (const Placement& place :
         {Placement{"origin", 1, 0}, {"offset", 1, 100}, {"large", 0x1p30, 0}, {"small", 0x1p-30, 0}}) {
        FanTally tally;
        for (int i = 0; i < 40'000; ++i)
            pairs_of(random_one_ring<Scalar>(place.scale, place.offset, random), place.scale, 5, random, tally);
        report(type, place.name, tally);
        EXPECT_GT(tally.different, 0);
        pairs += tally.pairs;
    }
    for (const auto& [name, soup] : {std::pair{"sphere", bumpy_sphere(12)}, {"terrain", terrain(24, 0.05, 2)}}) {
        const auto mesh = moved<Scalar>(soup, 1, D(3, -2, 1));
        FanTally tally;
        std::vector<Fan> fans = fans_of(mesh.view());
        std::erase_if(fans, [](const Fan& fan) { return fan.triangles.size() < 2; });
        for (int i = 0; i < 40'000; ++i) {
            const Fan& fan = fans[random.below(fans.size())];
            std::vector<Vec3<Scalar>> ring;
            for (const std::uint32_t v : fan.ring) ring.push_back(mesh.positions[v]);
            const auto& apex = mesh.positions[fan.apex];
            pairs_of(prepared<Scalar>(apex, ring), static_cast<double>((ring[0] - apex).norm()), 5, random, tally);
        }
        report(type, name, tally);
        pairs += tally.pairs;
    }
    EXPECT_GE(pairs, 1'000'000);
}

TEST(FanAgreement, InFloatOutsideOfTheBand) { run<float>(); }
TEST(FanAgreement, InDoubleOutsideOfTheBand) { run<double>(); }

}  // namespace
}  // namespace pierce::test

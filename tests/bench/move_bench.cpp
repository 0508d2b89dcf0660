// What a step of a particle costs that rests, slides, or meets nothing, near the ground and far above it: points and
// balls on a mesh that stands still, points on one that might move. Time of the thread a step, medians of interleaved
// repetitions, batches on one thread; `ratio free.resting VALUE` is that of a free one near the ground over that of one
// at rest. Arguments: none.
#include <algorithm>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <numeric>
#include <vector>

#include <pierce/pierce.h>
#include <support/meshes.h>

namespace pierce::bench {
namespace {

constexpr std::size_t k_count = 2000;
constexpr int k_repetitions = 15;
constexpr double k_seconds = 1.0 / 60;
constexpr int k_squares = 200;
constexpr double k_size = 100;  ///< of the ground: two triangles a square of half a unit

double thread_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <class Scalar>
struct Kind {
    const char* name;
    std::vector<Vec3<Scalar>> x, v;
    MoveOptions<Scalar> options;
    std::vector<double> nanoseconds;
    double queries = 0;
    double met = 0;
};

/// On: a mesh or a step.
template <class Scalar, class On>
void measure(const char* what, const On& on, Scalar radius, double& worst) {
    const Vec3<Scalar> push(0, 0, Scalar(-9.81 * k_seconds));
    test::Random random(3);
    MoveOptions<Scalar> friction{.response = {.friction = 2}};
    friction.radius = radius;
    MoveOptions<Scalar> smooth;
    smooth.radius = radius;
    std::vector<Move<Scalar>> moves(k_count);
    std::vector<Vec3<Scalar>> x, v(k_count, push);
    for (std::size_t i = 0; i < k_count; ++i)
        x.push_back((0.4 * k_size * random.in_cube().cwiseProduct(Vec3<double>(1, 1, 0)) + Vec3<double>(0, 0, 3))
                        .template cast<Scalar>());
    for (int step = 0; step < 400; ++step) {
        moves_and_bounce(on, x, v, Scalar(k_seconds), moves, friction);
        for (std::size_t i = 0; i < k_count; ++i) {
            x[i] = moves[i].position;
            v[i] = moves[i].velocity + push;
        }
    }
    std::vector<Vec3<Scalar>> place;
    for (std::size_t i = 0; i < k_count; ++i)
        if (moves[i].state == MoveState::resting) place.push_back(x[i]);
    const auto lifted_by = [&](double height) {
        std::vector<Vec3<Scalar>> out = place;
        for (Vec3<Scalar>& p : out) p[2] += static_cast<Scalar>(height);
        return out;
    };
    const std::size_t n = place.size();
    const std::vector<Vec3<Scalar>> falling(n, push);
    std::vector<Vec3<Scalar>> along;
    for (std::size_t i = 0; i < n; ++i) {
        Vec3<double> d = random.in_cube();
        d[2] = 0;
        along.push_back((2 * d.normalized()).template cast<Scalar>() + push);
    }
    std::vector<Kind<Scalar>> kinds{{"free, in the air", lifted_by(5), falling, friction, {}},
                                    {"free, near the ground", lifted_by(0.01), falling, friction, {}},
                                    {"resting", place, falling, friction, {}},
                                    {"free, fast, near the ground", lifted_by(0.05), along, smooth, {}},
                                    {"sliding", place, along, smooth, {}}};
    moves.resize(n);
    for (int repetition = 0; repetition <= k_repetitions; ++repetition)
        for (Kind<Scalar>& kind : kinds) {
            const double start = thread_seconds();
            const std::size_t met = moves_and_bounce(on, kind.x, kind.v, Scalar(k_seconds), moves, kind.options);
            const double took = thread_seconds() - start;
            if (repetition == 0) {  // which only warms up
                double queries = 0;
                for (const Move<Scalar>& move : moves) queries += move.casts;
                kind.queries = queries / static_cast<double>(n);
                kind.met = static_cast<double>(met) / static_cast<double>(n);
                continue;
            }
            kind.nanoseconds.push_back(1e9 * took / static_cast<double>(n));
        }
    std::cout << what << ", " << n << " particles:\n";
    for (Kind<Scalar>& kind : kinds) {
        std::nth_element(kind.nanoseconds.begin(), kind.nanoseconds.begin() + k_repetitions / 2,
                         kind.nanoseconds.end());
        std::cout << "  " << std::left << std::setw(30) << kind.name << std::right << std::fixed << std::setprecision(0)
                  << std::setw(7) << kind.nanoseconds[k_repetitions / 2] << " ns a step, " << std::setprecision(2)
                  << kind.queries << " queries, " << kind.met << " meet something\n";
    }
    worst = std::min(worst, kinds[1].nanoseconds[k_repetitions / 2] / kinds[2].nanoseconds[k_repetitions / 2]);
}

template <class Scalar>
void measure_all(const std::string& scalar, double& points, double& balls, double& steps) {
    TriangleSoup<double> ground = test::terrain(k_squares, 0.0015, 5);
    const TriangleSoup<Scalar> soup = test::moved<Scalar>(ground, k_size / 2, {0, 0, 0});
    const CollisionMesh<Scalar> mesh(soup.view());
    measure<Scalar>(("points, " + scalar).c_str(), mesh, 0, points);
    measure<Scalar>(("balls of 0.1, " + scalar).c_str(), mesh, Scalar(0.1), balls);
    measure<Scalar>(("balls of 1, " + scalar).c_str(), mesh, Scalar(1), balls);
    DeformingMesh<Scalar> moving(soup.view());
    measure<Scalar>(("points in a step, " + scalar).c_str(), moving.step(), 0, steps);
}

int run() {
    constexpr double k_none = 1e9;
    double points = k_none, balls = k_none, steps = k_none;
    measure_all<float>("float", points, balls, steps);
    measure_all<double>("double", points, balls, steps);
    std::cout << "ratio free.resting " << points << "\nratio free.resting.balls " << balls
              << "\nratio free.resting.step " << steps << '\n';
    return 0;
}

}  // namespace
}  // namespace pierce::bench

int main() { return pierce::bench::run(); }

// What a swept sphere costs beside Bullet's convex sweep of a sphere against the same mesh, in one process and on the
// same steps: `bullet.sphere` is Bullet's time over ours, single calls, medians of interleaved repetitions, for each
// radius; the last line is the least of them. Arguments: mesh files; without any, a bumpy sphere.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <vector>

#include <bench/bullet_shape.h>
#include <bench/table.h>
#include <pierce/pierce.h>
#include <support/meshes.h>
#include <support/segments.h>

namespace pierce::bench {
namespace {

constexpr std::size_t k_count = 4000;
constexpr int k_repetitions = 9;

using Steps = std::vector<Segment<float>>;

/// From places that are clear, `length` long, half of them aimed at a triangle.
Steps steps_for(const MeshView<float>& view, const CollisionMesh<float>& mesh, float radius, double length) {
    const test::Extent<float> extent(view);
    test::Random random(5);
    Steps out;
    while (out.size() < k_count) {
        const Vec3<double> target = test::corner(view, random.below(view.triangles.size()), 0);
        const Vec3<float> from = (target + (length + radius) * random.in_cube()).cast<float>();
        if (mesh.sphere_contacts(from, radius, {}) > 0) continue;
        const Vec3<double> start = from.cast<double>();
        Vec3<double> d = random.direction();
        if (out.size() % 2 == 0) d = (target - start).normalized();
        out.push_back({from, (start + length * d).cast<float>()});
    }
    return out;
}

btVector3 to_bullet(const Vec3<float>& p) { return {p[0], p[1], p[2]}; }

/// A world with one static mesh.
class Bullet {
  public:
    explicit Bullet(const MeshView<float>& view) : shape_(view) {
        shape_.get().setMargin(0);
        object_.setCollisionShape(&shape_.get());
        world_.addCollisionObject(&object_);
    }
    ~Bullet() { world_.removeCollisionObject(&object_); }
    Bullet(const Bullet&) = delete;
    Bullet& operator=(const Bullet&) = delete;

    [[nodiscard]] std::optional<float> sweep(const Segment<float>& step, const btSphereShape& sphere) const {
        const btVector3 from = to_bullet(step.from);
        const btVector3 to = to_bullet(step.to);
        btCollisionWorld::ClosestConvexResultCallback closest(from, to);
        world_.convexSweepTest(&sphere, btTransform(btQuaternion::getIdentity(), from),
                               btTransform(btQuaternion::getIdentity(), to), closest, 0);
        if (!closest.hasHit()) return std::nullopt;
        return closest.m_closestHitFraction;
    }

  private:
    BulletShape shape_;
    btCollisionObject object_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
};

template <class Query>
double nanoseconds(const Steps& steps, std::size_t& hits, Query&& query) {
    const auto start = std::chrono::steady_clock::now();
    for (const Segment<float>& step : steps) hits += query(step) ? std::size_t{1} : std::size_t{0};
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    return time.count() / static_cast<double>(steps.size());
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + k_repetitions / 2, values.end());
    return values[k_repetitions / 2];
}

double compare(const TriangleSoup<float>& soup, const std::string& name) {
    const CollisionMesh<float> mesh(soup.view());
    const CollisionMesh<double> fine_mesh(test::moved<double>(
                                              [&] {
                                                  TriangleSoup<double> wide;
                                                  for (const Vec3<float>& p : soup.positions)
                                                      wide.positions.push_back(p.cast<double>());
                                                  wide.triangles = soup.triangles;
                                                  return wide;
                                              }(),
                                              1, {0, 0, 0})
                                              .view());
    const Bullet bullet(soup.view());
    const double diagonal = test::Extent<float>(soup.view()).diagonal();
    Table table({"mesh", "radius / diagonal", "hits", "same answer", "pierce ns", "in double ns", "Bullet ns", "ratio",
                 "triangles", "exact"});
    double least = HUGE_VAL;
    for (const double part : {0.0005, 0.005, 0.05}) {
        const auto radius = static_cast<float>(part * diagonal);
        const Steps steps = steps_for(soup.view(), mesh, radius, 0.05 * diagonal);
        const btSphereShape sphere(radius);
        Share same;
        QueryCounters counters;
        std::size_t ours = 0;
        for (const Segment<float>& step : steps) {
            const auto hit = mesh.sweep_sphere(step, radius, {.counters = &counters});
            const auto theirs = bullet.sweep(step, sphere);
            ours += hit ? 1U : 0U;
            same.add(hit.has_value() == theirs.has_value() && (!hit || std::abs(hit->fraction - *theirs) < 0.01F));
        }
        std::vector<double> of_ours, of_fine, of_theirs, ratios;
        std::size_t unused = 0;
        for (int i = 0; i < k_repetitions; ++i) {
            of_ours.push_back(nanoseconds(
                steps, unused, [&](const Segment<float>& s) { return mesh.sweep_sphere(s, radius).has_value(); }));
            of_theirs.push_back(nanoseconds(
                steps, unused, [&](const Segment<float>& s) { return bullet.sweep(s, sphere).has_value(); }));
            of_fine.push_back(nanoseconds(steps, unused, [&](const Segment<float>& s) {
                return fine_mesh.sweep_sphere({s.from.cast<double>(), s.to.cast<double>()}, static_cast<double>(radius))
                    .has_value();
            }));
            ratios.push_back(of_theirs.back() / of_ours.back());
        }
        const auto text = [](double x, int digits) {
            std::ostringstream out;
            out << std::fixed << std::setprecision(digits) << x;
            return out.str();
        };
        const auto each = [&](std::uint64_t n) { return text(static_cast<double>(n) / k_count, 2); };
        least = std::min(least, median(ratios));
        table.add({name, text(part, 4), Share{ours, steps.size()}.percent(), same.percent(), text(median(of_ours), 0),
                   text(median(of_fine), 0), text(median(of_theirs), 0), text(median(ratios), 2),
                   each(counters.triangles), each(counters.exact_decisions)});
    }
    table.print(std::cout);
    return least;
}

}  // namespace
}  // namespace pierce::bench

int main(int count, char** arguments) {
    using namespace pierce;
    using namespace pierce::bench;
    double least = HUGE_VAL;
    if (count == 1) least = compare(test::moved<float>(test::bumpy_sphere(60), 1, {0, 0, 0}), "bumpy sphere");
    for (int i = 1; i < count; ++i) least = std::min(least, compare(read_mesh<float>(arguments[i]), arguments[i]));
    std::cout << "ratio bullet.sphere " << std::fixed << std::setprecision(2) << least << '\n';
}

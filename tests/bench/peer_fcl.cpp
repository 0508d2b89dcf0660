// FCL: a BVHModel in double, asked by fcl::collide. It has no rays: the way is a capsule of radius 0, and what it meets
// first is found by its user, who computes where the way passes through the plane of each triangle that is reported.
#include <algorithm>
#include <vector>

#include <fcl/config.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/narrowphase/collision.h>
#include <Eigen/Geometry>

#include "peers.h"

namespace pierce::bench {
namespace {

class Fcl : public Peer {
  public:
    Fcl(const TriangleSoup<float>& soup, Backs backs) : cull_backs_(backs == Backs::culled) {
        for (const Vec3<float>& p : soup.positions) positions_.push_back(p.cast<double>());
        for (const auto& [a, b, c] : soup.triangles) triangles_.emplace_back(a, b, c);
        mesh_.beginModel();
        mesh_.addSubModel(positions_, triangles_);
        mesh_.endModel();
    }

    [[nodiscard]] Point rounded(const Point& p) const override { return p; }

    [[nodiscard]] std::optional<Stop> first(const Point& from, const Point& to) const override {
        const Point way = to - from;
        std::optional<Stop> stop;
        double first = 0;
        for (const std::size_t triangle : met(from, to)) {
            const auto corner = [&](int k) { return positions_[triangles_[triangle][k]]; };
            const Point normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
            const double approach = -normal.dot(way);
            if (cull_backs_ && !(approach > 0)) continue;
            // Where the way lies in the plane it is met at once.
            const double at = approach == 0 ? 0 : std::clamp(normal.dot(from - corner(0)) / approach, 0.0, 1.0);
            if (stop && first <= at) continue;
            first = at;
            stop = Stop{from + at * way, normal};
        }
        return stop;
    }
    [[nodiscard]] std::size_t count(const Point& from, const Point& to) const override { return met(from, to).size(); }

  private:
    /// The triangles that FCL reports.
    [[nodiscard]] std::vector<std::size_t> met(const Point& from, const Point& to) const {
        std::vector<std::size_t> met;
        const Point way = to - from;
        if (way == Point::Zero()) return met;
        const fcl::Capsuled capsule(0, way.norm());
        fcl::Transform3d place = fcl::Transform3d::Identity();
        place.linear() = Eigen::Quaterniond::FromTwoVectors(Point::UnitZ(), way).toRotationMatrix();
        place.translation() = 0.5 * (from + to);
        constexpr bool k_with_depths = false;  // which triangles are met, not how deep
        fcl::CollisionResultd result;
        fcl::collide<double>(&mesh_, fcl::Transform3d::Identity(), &capsule, place,
                             fcl::CollisionRequestd(1000, k_with_depths), result);
        for (std::size_t i = 0; i < result.numContacts(); ++i)
            met.push_back(static_cast<std::size_t>(result.getContact(i).b1));
        return met;
    }

    std::vector<Point> positions_;
    std::vector<fcl::Triangle> triangles_;
    fcl::BVHModel<fcl::OBBRSSd> mesh_;
    bool cull_backs_;
};

}  // namespace

std::unique_ptr<Peer> make_fcl(const TriangleSoup<float>& soup, Backs backs) {
    return std::make_unique<Fcl>(soup, backs);
}
std::string fcl_version() { return FCL_VERSION; }

}  // namespace pierce::bench

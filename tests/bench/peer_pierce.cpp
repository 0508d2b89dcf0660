// pierce, in float and in double: fronts of faces.
#include <pierce/collision_mesh.h>

#include "peers.h"

namespace pierce::bench {
namespace {

template <class Scalar>
std::vector<Vec3<Scalar>> positions_of(const TriangleSoup<float>& soup) {
    std::vector<Vec3<Scalar>> positions;
    for (const Vec3<float>& p : soup.positions) positions.push_back(p.cast<Scalar>());
    return positions;
}

template <class Scalar>
class Pierce : public Peer {
  public:
    explicit Pierce(const TriangleSoup<float>& soup) : mesh_({positions_of<Scalar>(soup), soup.triangles}) {}

    [[nodiscard]] Point rounded(const Point& p) const override { return p.cast<Scalar>().template cast<double>(); }

    [[nodiscard]] std::optional<Stop> first(const Point& from, const Point& to) const override {
        const auto hit = mesh_.first_hit(segment(from, to));
        if (!hit) return std::nullopt;
        return Stop{hit->point.template cast<double>(), hit->normal.template cast<double>()};
    }
    [[nodiscard]] std::size_t count(const Point& from, const Point& to) const override {
        return mesh_.all_hits(segment(from, to), {});
    }
    [[nodiscard]] std::optional<int> crossings(const Point& from, const Point& to) const override {
        return mesh_.crossings(segment(from, to));
    }

  private:
    static Segment<Scalar> segment(const Point& from, const Point& to) {
        return {from.cast<Scalar>(), to.cast<Scalar>()};
    }

    CollisionMesh<Scalar> mesh_;
};

}  // namespace

std::unique_ptr<Peer> make_pierce_float(const TriangleSoup<float>& soup, Backs) {
    return std::make_unique<Pierce<float>>(soup);
}
std::unique_ptr<Peer> make_pierce_double(const TriangleSoup<float>& soup, Backs) {
    return std::make_unique<Pierce<double>>(soup);
}

}  // namespace pierce::bench

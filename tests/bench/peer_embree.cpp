// Embree 3: rtcIntersect1 for the first hit, a filter function in the intersection context for all of them. Debian's
// build does not cull backs, so both sides count unless the same filter rejects backs.
#include "embree_scene.h"
#include "peers.h"

namespace pierce::bench {
namespace {

const EmbreeDevice& device() {
    static const EmbreeDevice instance("");
    return instance;
}

// The context comes first: the filter gets a pointer to it, and finds the rest there.
struct Query {
    RTCIntersectContext context;
    bool cull_backs;
    bool take_none;
    std::size_t count;
};

void filter(const RTCFilterFunctionNArguments* arguments) {
    auto* query = reinterpret_cast<Query*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const unsigned n = arguments->N;
        const float along_normal = RTCHitN_Ng_x(arguments->hit, n, i) * RTCRayN_dir_x(arguments->ray, n, i) +
                                   RTCHitN_Ng_y(arguments->hit, n, i) * RTCRayN_dir_y(arguments->ray, n, i) +
                                   RTCHitN_Ng_z(arguments->hit, n, i) * RTCRayN_dir_z(arguments->ray, n, i);
        const bool taken = !query->cull_backs || along_normal < 0;
        query->count += taken ? 1 : 0;
        if (!taken || query->take_none) arguments->valid[i] = 0;
    }
}

class Embree : public Peer {
  public:
    Embree(const TriangleSoup<float>& soup, RTCSceneFlags flags, Backs backs)
        : scene_(device(), soup.view(),
                 {.flags = static_cast<RTCSceneFlags>(flags | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION)}),
          cull_backs_(backs == Backs::culled) {}

    [[nodiscard]] Point rounded(const Point& p) const override { return p.cast<float>().cast<double>(); }

    [[nodiscard]] std::optional<Stop> first(const Point& from, const Point& to) const override {
        RTCRayHit ray = ray_along(from, to);
        intersect(ray, false);
        if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
        const Vec3<float> start = from.cast<float>();
        const Vec3<float> point = start + ray.ray.tfar * (to.cast<float>() - start);
        const Point normal(double(ray.hit.Ng_x), double(ray.hit.Ng_y), double(ray.hit.Ng_z));
        return Stop{point.cast<double>(), normal.normalized()};
    }
    [[nodiscard]] std::size_t count(const Point& from, const Point& to) const override {
        RTCRayHit ray = ray_along(from, to);
        return intersect(ray, true);
    }

  private:
    static RTCRayHit ray_along(const Point& from, const Point& to) {
        const Vec3<float> start = from.cast<float>();
        RTCRayHit ray = {};
        set_ray(ray, start, to.cast<float>() - start);
        return ray;
    }

    std::size_t intersect(RTCRayHit& ray, bool take_none) const {
        Query query = {.context = {}, .cull_backs = cull_backs_, .take_none = take_none, .count = 0};
        rtcInitIntersectContext(&query.context);
        if (cull_backs_ || take_none) query.context.filter = filter;
        rtcIntersect1(scene_.get(), &query.context, &ray);
        return query.count;
    }

    EmbreeScene scene_;
    bool cull_backs_;
};

}  // namespace

std::unique_ptr<Peer> make_embree_default(const TriangleSoup<float>& soup, Backs backs) {
    return std::make_unique<Embree>(soup, RTC_SCENE_FLAG_NONE, backs);
}
std::unique_ptr<Peer> make_embree_robust(const TriangleSoup<float>& soup, Backs backs) {
    return std::make_unique<Embree>(soup, RTC_SCENE_FLAG_ROBUST, backs);
}
std::string embree_version() { return RTC_VERSION_STRING; }

}  // namespace pierce::bench

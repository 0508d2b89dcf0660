// Embree 3: rtcIntersect1 for the first hit, a filter function in the intersection context for all of them. Debian's
// build does not cull backs, so both sides count unless the same filter rejects backs.
#include <cstring>
#include <stdexcept>

#include <embree3/rtcore.h>

#include "peers.h"

namespace pierce::bench {
namespace {

RTCDevice device() {
    static const RTCDevice instance = rtcNewDevice(nullptr);
    if (instance == nullptr) throw std::runtime_error("Embree does not start");
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
        : scene_(rtcNewScene(device())), cull_backs_(backs == Backs::culled) {
        rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(flags | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
        const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
        void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                 3 * sizeof(float), soup.positions.size());
        void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                3 * sizeof(unsigned), soup.triangles.size());
        std::memcpy(vertices, soup.positions.data(), soup.positions.size() * sizeof(Vec3<float>));
        std::memcpy(indices, soup.triangles.data(), soup.triangles.size() * sizeof(IndexTriple));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
        if (rtcGetDeviceError(device()) != RTC_ERROR_NONE) throw std::runtime_error("Embree does not take the mesh");
    }
    ~Embree() override { rtcReleaseScene(scene_); }

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
        const Vec3<float> way = to.cast<float>() - start;
        RTCRayHit ray = {};
        ray.ray.org_x = start[0];
        ray.ray.org_y = start[1];
        ray.ray.org_z = start[2];
        ray.ray.dir_x = way[0];
        ray.ray.dir_y = way[1];
        ray.ray.dir_z = way[2];
        ray.ray.tnear = 0;
        ray.ray.tfar = 1;
        ray.ray.mask = ~0u;
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        return ray;
    }

    std::size_t intersect(RTCRayHit& ray, bool take_none) const {
        Query query = {.context = {}, .cull_backs = cull_backs_, .take_none = take_none, .count = 0};
        rtcInitIntersectContext(&query.context);
        if (cull_backs_ || take_none) query.context.filter = filter;
        rtcIntersect1(scene_, &query.context, &ray);
        return query.count;
    }

    RTCScene scene_;
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

#include <immintrin.h>

#include "../embree_scene.h"
#include "column.h"

namespace pierce::bench {
namespace {

/// Denormals flushed to zero and read as zero, for as long as it lives: Embree's manual asks for it.
class FlushedDenormals {
  public:
    FlushedDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040U); }
    ~FlushedDenormals() { _mm_setcsr(saved_); }
    FlushedDenormals(const FlushedDenormals&) = delete;
    FlushedDenormals& operator=(const FlushedDenormals&) = delete;

  private:
    unsigned saved_;
};

/// A scene and the one device that all scenes share: it must outlive them.
struct Scene {
    Scene(const MeshView<float>& mesh, const EmbreeOptions& options) : scene(device(), mesh, options) {
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    }
    static const EmbreeDevice& device() {
        static const EmbreeDevice instance("threads=1");
        return instance;
    }
    EmbreeScene scene;
    RTCIntersectContext context;
};

class EmbreeColumn : public Column {
  public:
    EmbreeColumn(std::string_view name, std::shared_ptr<Scene> scene) : Column(name), scene_(std::move(scene)) {}

    void prepare(std::span<const Segment<float>> segments) override {
        rays_.clear();
        for (const Segment<float>& s : segments) rays_.push_back({s.from, s.to - s.from});
    }

  protected:
    struct Ray {
        Vec3<float> from;
        Vec3<float> way;
    };
    [[nodiscard]] RTCScene scene() const { return scene_->scene.get(); }
    [[nodiscard]] RTCIntersectContext* context() const { return &scene_->context; }
    [[nodiscard]] const Ray& ray(std::size_t i) const { return rays_[i]; }

  private:
    std::shared_ptr<Scene> scene_;
    std::vector<Ray> rays_;
};

class First : public EmbreeColumn {
  public:
    using EmbreeColumn::EmbreeColumn;
    std::size_t ask(std::size_t begin, std::size_t end) override {
        const FlushedDenormals flushed;
        std::size_t hits = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const RTCRayHit hit = intersect(i);
            hits += hit.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1U : 0U;
        }
        return hits;
    }
    Answer answer(std::size_t i) override {
        const FlushedDenormals flushed;
        const RTCRayHit hit = intersect(i);
        return hit.hit.geomID != RTC_INVALID_GEOMETRY_ID ? Answer{true, double(hit.ray.tfar)} : Answer{};
    }

  private:
    [[nodiscard]] RTCRayHit intersect(std::size_t i) const {
        RTCRayHit hit;
        set_ray(hit, ray(i).from, ray(i).way);
        rtcIntersect1(scene(), context(), &hit);
        return hit;
    }
};

class Any : public EmbreeColumn {
  public:
    using EmbreeColumn::EmbreeColumn;
    std::size_t ask(std::size_t begin, std::size_t end) override {
        const FlushedDenormals flushed;
        std::size_t hits = 0;
        for (std::size_t i = begin; i < end; ++i) {
            RTCRay hit;
            set_ray(hit, ray(i).from, ray(i).way);
            rtcOccluded1(scene(), context(), &hit);
            hits += hit.tfar < 0 ? 1U : 0U;
        }
        return hits;
    }
};

class Stream : public EmbreeColumn {
  public:
    using EmbreeColumn::EmbreeColumn;
    std::size_t ask(std::size_t begin, std::size_t end) override {
        const FlushedDenormals flushed;
        std::size_t hits = 0;
        for (std::size_t at = begin; at < end; at += k_block) {
            const std::size_t count = std::min(k_block, end - at);
            for (std::size_t i = 0; i < count; ++i) set_ray(block_[i], ray(at + i).from, ray(at + i).way);
            rtcIntersect1M(scene(), context(), block_.data(), static_cast<unsigned>(count), sizeof(RTCRayHit));
            for (std::size_t i = 0; i < count; ++i) hits += block_[i].hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1U : 0U;
        }
        return hits;
    }

  private:
    static constexpr std::size_t k_block = 256;  // they stay in the cache
    std::vector<RTCRayHit> block_{k_block};
};

std::shared_ptr<Scene> make_scene(const MeshView<float>& mesh, RTCSceneFlags flags, RTCBuildQuality quality) {
    return std::make_shared<Scene>(mesh, EmbreeOptions{.flags = flags, .quality = quality});
}

}  // namespace

void add_embree_columns(Columns& columns, const MeshView<float>& mesh, bool all) {
    const auto high = make_scene(mesh, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_HIGH);
    columns.push_back(std::make_unique<First>(column::embree, high));
    columns.push_back(std::make_unique<Any>(column::embree_any, high));
    columns.push_back(std::make_unique<Stream>(column::embree_stream, high));
    if (!all) return;
    columns.push_back(std::make_unique<First>(column::embree_robust,
                                              make_scene(mesh, RTC_SCENE_FLAG_ROBUST, RTC_BUILD_QUALITY_HIGH)));
    columns.push_back(
        std::make_unique<First>(column::embree_low, make_scene(mesh, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_LOW)));
}

}  // namespace pierce::bench

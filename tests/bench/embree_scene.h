// Embree's device and scene, and the ray of a segment, for whoever asks it.
#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <embree3/rtcore.h>

#include <pierce/triangle_soup.h>

namespace pierce::bench {

/// Counts the bytes that Embree holds, as Embree says. `configuration` is that of rtcNewDevice, such as "threads=1".
class EmbreeDevice {
  public:
    explicit EmbreeDevice(const std::string& configuration) : device_(rtcNewDevice(configuration.c_str())) {
        if (device_ == nullptr) throw std::runtime_error("Embree does not start");
        rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
    }
    ~EmbreeDevice() { rtcReleaseDevice(device_); }
    EmbreeDevice(const EmbreeDevice&) = delete;
    EmbreeDevice& operator=(const EmbreeDevice&) = delete;

    [[nodiscard]] RTCDevice get() const { return device_; }
    [[nodiscard]] std::size_t bytes() const { return static_cast<std::size_t>(bytes_); }

  private:
    static bool count_bytes(void* sum, ssize_t bytes, bool) {
        __atomic_fetch_add(static_cast<long long*>(sum), bytes, __ATOMIC_RELAXED);  // Embree's threads call it
        return true;
    }

    long long bytes_ = 0;
    RTCDevice device_;
};

struct EmbreeOptions {
    RTCSceneFlags flags = RTC_SCENE_FLAG_NONE;
    RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM;
    bool refits = false;  ///< the geometry is refitted where it is changed, and not built again
};

/// One geometry of triangles, committed, in buffers that Embree owns.
class EmbreeScene {
  public:
    EmbreeScene(const EmbreeDevice& device, const MeshView<float>& mesh, const EmbreeOptions& options)
        : scene_(rtcNewScene(device.get())), geometry_(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE)) {
        rtcSetSceneFlags(scene_, options.flags);
        rtcSetSceneBuildQuality(scene_, options.quality);
        rtcSetGeometryBuildQuality(geometry_, options.refits ? RTC_BUILD_QUALITY_REFIT : options.quality);
        vertices_ = rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                            mesh.positions.size());
        void* const indices = rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                      3 * sizeof(unsigned), mesh.triangles.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            std::memcpy(static_cast<float*>(vertices_) + 3 * i, mesh.positions[i].data(), 3 * sizeof(float));
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            std::memcpy(static_cast<unsigned*>(indices) + 3 * i, mesh.triangles[i].data(), 3 * sizeof(unsigned));
        rtcCommitGeometry(geometry_);
        rtcAttachGeometry(scene_, geometry_);
        rtcCommitScene(scene_);
        if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE)
            throw std::runtime_error("Embree does not take the mesh");
    }
    ~EmbreeScene() {
        rtcReleaseGeometry(geometry_);
        rtcReleaseScene(scene_);
    }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    [[nodiscard]] RTCScene get() const { return scene_; }

    /// New positions, which `rebuild` takes up.
    void place(const std::vector<Vec3<float>>& positions) const {
        std::memcpy(vertices_, positions.data(), positions.size() * sizeof positions[0]);
    }

    /// Builds again, or refits, as for a mesh whose vertices have moved.
    void rebuild() const {
        rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
        rtcCommitGeometry(geometry_);
        rtcCommitScene(scene_);
    }

  private:
    RTCScene scene_;
    RTCGeometry geometry_;
    void* vertices_ = nullptr;
};

/// Everything that rtcOccluded1 reads: a segment is the ray from 0 to 1 along `to - from`.
inline void set_ray(RTCRay& ray, const Vec3<float>& from, const Vec3<float>& way) {
    ray.org_x = from[0];
    ray.org_y = from[1];
    ray.org_z = from[2];
    ray.tnear = 0;
    ray.dir_x = way[0];
    ray.dir_y = way[1];
    ray.dir_z = way[2];
    ray.time = 0;
    ray.tfar = 1;
    ray.mask = ~0U;
    ray.id = 0;
    ray.flags = 0;
}

/// Everything that rtcIntersect1 reads.
inline void set_ray(RTCRayHit& ray, const Vec3<float>& from, const Vec3<float>& way) {
    set_ray(ray.ray, from, way);
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
}

}  // namespace pierce::bench

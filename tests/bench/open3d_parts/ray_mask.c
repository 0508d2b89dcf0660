// Preloaded, it makes Debian's Open3D hit anything at all. Open3D leaves the mask of its rays at 0, which Embree
// ignores as Open3D's own wheels build it; Debian's Embree looks at masks, and then such a ray hits nothing.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <embree3/rtcore.h>

typedef void (*Intersect)(RTCScene, struct RTCIntersectContext*, struct RTCRayHit*, unsigned int, size_t);
typedef void (*Occluded)(RTCScene, struct RTCIntersectContext*, struct RTCRay*, unsigned int, size_t);

// Python loads Open3D and with it Embree where RTLD_NEXT does not look.
static void* of_embree(const char* name) { return dlsym(dlopen("libembree3.so.3", RTLD_LAZY), name); }

static void open_masks(char* ray, unsigned int count, size_t stride) {
    for (; count > 0; --count, ray += stride) ((struct RTCRay*)ray)->mask = 0xffffffff;
}

void rtcIntersect1M(RTCScene scene, struct RTCIntersectContext* context, struct RTCRayHit* rays, unsigned int count,
                    size_t stride) {
    static Intersect intersect = 0;
    if (!intersect) intersect = (Intersect)of_embree("rtcIntersect1M");
    open_masks((char*)rays, count, stride);  // an RTCRayHit begins with its ray
    intersect(scene, context, rays, count, stride);
}

void rtcOccluded1M(RTCScene scene, struct RTCIntersectContext* context, struct RTCRay* rays, unsigned int count,
                   size_t stride) {
    static Occluded occluded = 0;
    if (!occluded) occluded = (Occluded)of_embree("rtcOccluded1M");
    open_masks((char*)rays, count, stride);
    occluded(scene, context, rays, count, stride);
}

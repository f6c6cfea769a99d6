#pragma once

#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h>
#endif

// The one place that knows which major version of Embree is present. Version 4 renamed the header
// and replaced the intersection context by arguments; all that Gnomon needs of either is below.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <memory>
#include <type_traits>

namespace gnomon::truth::embree {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};

using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseGeometry>;

/// Whether the rays of a packet take nearly the same way, which decides how they are traced.
enum class Rays { coherent, incoherent };

#if RTC_VERSION_MAJOR >= 4

inline void occluded16(const int* valid, RTCScene scene, RTCRay16& rays, Rays kind) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags =
      kind == Rays::coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  rtcOccluded16(valid, scene, &rays, &arguments);
}

inline void occluded1(RTCScene scene, RTCRay& ray) {
  rtcOccluded1(scene, &ray, nullptr);
}

inline void intersect1(RTCScene scene, RTCRayHit& ray) {
  rtcIntersect1(scene, &ray, nullptr);
}

#else

inline void occluded16(const int* valid, RTCScene scene, RTCRay16& rays, Rays kind) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = kind == Rays::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                         : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcOccluded16(valid, scene, &context, &rays);
}

inline void occluded1(RTCScene scene, RTCRay& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
}

inline void intersect1(RTCScene scene, RTCRayHit& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
}

#endif

}  // namespace gnomon::truth::embree

namespace gnomon::truth {

/// Has the processor treat denormal floats as zero on this thread, as Embree asks of its callers,
/// and puts the mode back when it goes. Nothing on other processors.
class FlushDenormals {
 public:
#if defined(__x86_64__) || defined(__i386__)
  FlushDenormals() : before_(_mm_getcsr()) {
    constexpr unsigned flushToZero = 0x8000;
    constexpr unsigned denormalsAreZero = 0x0040;
    _mm_setcsr(before_ | flushToZero | denormalsAreZero);
  }
  ~FlushDenormals() {
    _mm_setcsr(before_);
  }
#else
  FlushDenormals() = default;
  ~FlushDenormals() = default;
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
#if defined(__x86_64__) || defined(__i386__)
  unsigned before_;
#endif
};

}  // namespace gnomon::truth

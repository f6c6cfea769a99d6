#include "render/gl_context.h"

// Only this header of libepoxy declares both EGL and its extensions.
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/core.h>

#include <array>
#include <vector>

#include "common/error.h"

namespace gnomon::render {

struct GlContext::Egl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  Egl() = default;
  Egl(const Egl&) = delete;
  Egl& operator=(const Egl&) = delete;
  ~Egl() { close(); }

  /// The display stays initialised: EGL has one of a platform for the whole process, counts nobody,
  /// and would take it from the contexts of all other threads too.
  void close() {
    if (display == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    display = EGL_NO_DISPLAY;
    context = EGL_NO_CONTEXT;
  }

  /// Empty if a context is current now, else what stood in the way.
  std::string open(EGLenum platform, void* native) {
    display = eglGetPlatformDisplayEXT(platform, native, nullptr);
    if (display == EGL_NO_DISPLAY) return "no display";
    EGLint major = 0;
    EGLint minor = 0;
    if (eglInitialize(display, &major, &minor) == EGL_FALSE) {
      display = EGL_NO_DISPLAY;
      return "cannot be initialised";
    }
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return "has no desktop OpenGL";
    const std::array<EGLint, 7> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                              4,
                                              EGL_CONTEXT_MINOR_VERSION,
                                              5,
                                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                              EGL_NONE};
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context == EGL_NO_CONTEXT) return "has no OpenGL 4.5 core";
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
      return "cannot render without a surface";
    }
    return {};
  }
};

namespace {

/// libepoxy ends the process where it finds no library to load, so ask before it does.
void requireLibraries() {
  const auto loads = [](const char* name) {
    return dlopen(name, RTLD_LAZY | RTLD_LOCAL) != nullptr;
  };
  if (!loads("libEGL.so.1")) {
    throw NoGlError("no OpenGL: libEGL.so.1 cannot be loaded. Install it (Debian: libegl1)");
  }
  if (!loads("libGL.so.1") && !loads("libOpenGL.so.0")) {
    throw NoGlError(
        "no OpenGL: neither libGL.so.1 nor libOpenGL.so.0 can be loaded. Install one (Debian: "
        "libopengl0)");
  }
}

std::vector<EGLDeviceEXT> eglDevices() {
  EGLint count = 0;
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") ||
      eglQueryDevicesEXT(0, nullptr, &count) == EGL_FALSE) {
    return {};
  }
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  eglQueryDevicesEXT(count, devices.data(), &count);
  devices.resize(static_cast<std::size_t>(count));
  return devices;
}

std::string glString(GLenum name) {
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text != nullptr ? text : "unknown";
}

}  // namespace

GlContext::GlContext() : egl_(std::make_unique<Egl>()) {
  requireLibraries();
  std::string answers = "surfaceless platform: not offered";
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
      const std::string answer = egl_->open(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
      if (answer.empty()) return;
      answers = "surfaceless platform: " + answer;
      egl_->close();
    }
    const auto devices = eglDevices();
    for (std::size_t i = 0; i < devices.size(); ++i) {
      const std::string answer = egl_->open(EGL_PLATFORM_DEVICE_EXT, devices[i]);
      if (answer.empty()) return;
      answers += fmt::format("; device {}: {}", i, answer);
      egl_->close();
    }
  }
  throw NoGlError(fmt::format(
      "no OpenGL 4.5 context: {}. Install a driver (Debian: libgl1-mesa-dri)", answers));
}

GlContext::~GlContext() = default;

GlDriver currentDriver() {
  return {glString(GL_VENDOR), glString(GL_RENDERER), glString(GL_VERSION)};
}

void throwOnGlError(const char* task) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  if (error == GL_OUT_OF_MEMORY) {
    throw MemoryError(fmt::format("OpenGL ran out of memory while {}", task));
  }
  throw InternalError(fmt::format("OpenGL error 0x{:04x} while {}", error, task));
}

}  // namespace gnomon::render

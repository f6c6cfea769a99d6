#pragma once

#include <memory>
#include <string>

namespace gnomon::render {

/// The driver's own description.
struct GlDriver {
  std::string vendor;    ///< GL_VENDOR
  std::string renderer;  ///< GL_RENDERER
  std::string version;   ///< GL_VERSION
};

/// The driver of the context that is current.
GlDriver currentDriver();

/// An OpenGL 4.5 core context without a window, current on the thread that made it until it goes.
/// EGL's surfaceless platform is tried first, then each EGL device: no display is needed.
class GlContext {
 public:
  /// @throws NoGlError with the answer of each platform
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  [[nodiscard]] GlDriver driver() const { return currentDriver(); }

 private:
  struct Egl;
  std::unique_ptr<Egl> egl_;
};

/// Throws InternalError if GL recorded an error since the last call.
/// @param task  for the message: "reading the samples of a view"
void throwOnGlError(const char* task);

}  // namespace gnomon::render

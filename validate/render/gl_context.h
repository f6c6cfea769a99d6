#pragma once

#include <memory>
#include <string>

namespace gnomon {

/// An OpenGL 4.5 core context without a window, current on the thread that made it until it goes.
/// EGL's surfaceless platform is tried first, then each EGL device: no display is needed.
class GlContext {
 public:
  /// @throws NoGlError naming what each platform answered
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  [[nodiscard]] std::string vendor() const;    ///< GL_VENDOR
  [[nodiscard]] std::string renderer() const;  ///< GL_RENDERER
  [[nodiscard]] std::string version() const;   ///< GL_VERSION
  /// Largest side of a two- or three-dimensional texture, texels.
  [[nodiscard]] int largestTexture() const;
  [[nodiscard]] int largestVolume() const;

 private:
  struct Egl;
  std::unique_ptr<Egl> egl_;
};

/// Throws InternalError if GL recorded an error since the last call.
/// @param task  what was being done, for the message
void throwOnGlError(const char* task);

}  // namespace gnomon

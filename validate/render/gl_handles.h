#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace gnomon::render::gl {

/// Owns one GL object name and deletes it with the context still current.
template <typename Deleter>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : name_(name) {}
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (name_ != 0) Deleter{}(name_);
  }

  [[nodiscard]] GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

struct DeleteTexture {
  void operator()(GLuint name) const { glDeleteTextures(1, &name); }
};
struct DeleteBuffer {
  void operator()(GLuint name) const { glDeleteBuffers(1, &name); }
};
struct DeleteVertexArray {
  void operator()(GLuint name) const { glDeleteVertexArrays(1, &name); }
};
struct DeleteFramebuffer {
  void operator()(GLuint name) const { glDeleteFramebuffers(1, &name); }
};
struct DeleteShader {
  void operator()(GLuint name) const { glDeleteShader(name); }
};
struct DeleteQuery {
  void operator()(GLuint name) const { glDeleteQueries(1, &name); }
};
struct DeleteProgram {
  void operator()(GLuint name) const { glDeleteProgram(name); }
};

using Texture = Handle<DeleteTexture>;
using Buffer = Handle<DeleteBuffer>;
using VertexArray = Handle<DeleteVertexArray>;
using Framebuffer = Handle<DeleteFramebuffer>;
using Query = Handle<DeleteQuery>;
using Shader = Handle<DeleteShader>;
using Program = Handle<DeleteProgram>;

inline Query makeTimeQuery() {
  GLuint name = 0;
  glCreateQueries(GL_TIME_ELAPSED, 1, &name);
  return Query(name);
}
inline Framebuffer makeFramebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return Framebuffer(name);
}

}  // namespace gnomon::render::gl

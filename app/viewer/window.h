#pragma once

#include <string>

struct GLFWwindow;

namespace gnomon {

/// A window with an OpenGL 4.5 core context, current on the thread that made it.
class Window {
 public:
  /// @throws NoGlError where there is no display, or none with that OpenGL
  Window(int width, int height, const std::string& title);
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  ~Window();

  [[nodiscard]] GLFWwindow* handle() const { return window_; }
  [[nodiscard]] bool wantsToClose() const;
  void show();

  struct Size {
    int width;
    int height;
  };
  /// Of what is drawn, pixels.
  [[nodiscard]] Size size() const;
  /// Hands the picture over.
  void swap();
  /// Reads input; waits for it at most so long, or until `wake` is called.
  void readInput(double seconds);
  /// Ends a wait, from any thread.
  static void wake();

 private:
  GLFWwindow* window_ = nullptr;
};

}  // namespace gnomon

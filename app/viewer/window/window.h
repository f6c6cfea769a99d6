#pragma once

#include <string>
#include <utility>
#include <vector>

struct GLFWwindow;

namespace gnomon::app {

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
  /// The keys that went down since the last call, as GLFW numbers them, letters by what the
  /// person's keyboard bears; arrows repeat. None is
  /// lost, however short, and however long a frame takes.
  std::vector<int> takeKeys() { return std::exchange(keys_, {}); }
  /// Ends a wait, from any thread.
  static void wake();

 private:
  GLFWwindow* window_ = nullptr;
  std::vector<int> keys_;
};

}  // namespace gnomon::app

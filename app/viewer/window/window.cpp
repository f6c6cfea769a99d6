#include "viewer/window/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/core.h>

#include <cstdlib>

#include "common/error.h"
#include "common/text.h"

namespace gnomon::app {
namespace {

std::string lastError() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? oneLine(text) : "no reason given";
}

[[noreturn]] void refuse(const std::string& what) {
  throw NoGlError(fmt::format("no window: {}. Without a display use --screenshot", what));
}

/// The key that bears a letter on the person's own keyboard: GLFW numbers keys by where they are
/// on an American one, which has Z where a German one has Y.
int keyByLetter(int key, int scancode) {
  const char* name = glfwGetKeyName(key, scancode);
  const bool isLetter = name != nullptr && name[0] >= 'a' && name[0] <= 'z' && name[1] == '\0';
  return isLetter ? GLFW_KEY_A + (name[0] - 'a') : key;
}

/// GLFW 3.4 asks for Wayland first, whose library writes a line of its own where it has no folder
/// to look for a display in.
void avoidWaylandWithoutAFolder() {
#ifdef GLFW_PLATFORM
  const auto isSet = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  const bool hasX11 = glfwPlatformSupported(GLFW_PLATFORM_X11) == GLFW_TRUE;
  if (hasX11 && !isSet("XDG_RUNTIME_DIR") && !isSet("WAYLAND_SOCKET")) {
    glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
  }
#endif
}

}  // namespace

Window::Window(int width, int height, const std::string& title) {
  avoidWaylandWithoutAFolder();
  if (glfwInit() == GLFW_FALSE) refuse(lastError());
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  // The panes' passes have depths of their own.
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string why = lastError();
    glfwTerminate();
    refuse(why);
  }
  glfwMakeContextCurrent(window_);
  glfwSetWindowUserPointer(window_, &keys_);
  // Dear ImGui sets its own callback later and calls this one from there.
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scancode, int action, int) {
    // Only arrows repeat: of the others a second press undoes the first.
    const bool repeats = key >= GLFW_KEY_RIGHT && key <= GLFW_KEY_UP;
    if (action == GLFW_RELEASE || (action == GLFW_REPEAT && !repeats)) return;
    static_cast<std::vector<int>*>(glfwGetWindowUserPointer(window))
        ->push_back(keyByLetter(key, scancode));
  });
  glfwSwapInterval(1);
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool Window::wantsToClose() const {
  return glfwWindowShouldClose(window_) != GLFW_FALSE;
}

void Window::show() {
  glfwShowWindow(window_);
}

Window::Size Window::size() const {
  Size size{};
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  return size;
}

void Window::swap() {
  glfwSwapBuffers(window_);
}

void Window::readInput(double seconds) {
  if (seconds > 0) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
}

void Window::wake() {
  glfwPostEmptyEvent();
}

}  // namespace gnomon::app

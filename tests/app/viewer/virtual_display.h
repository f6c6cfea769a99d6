#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gnomon::test {

/// An X server without a screen to look at, for as long as it lives.
class VirtualDisplay {
 public:
  VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;
  ~VirtualDisplay();

  /// ":99", or empty where there is no such server.
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  pid_t process_ = -1;
  std::string name_;
};

/// `gnomon view` in a window of a virtual display, driven by a virtual mouse and keyboard: the path
/// that a person's input takes.
class DrivenViewer {
 public:
  DrivenViewer(const VirtualDisplay& display, std::filesystem::path folder,
               std::vector<std::string> arguments, std::vector<std::string> environment = {});
  DrivenViewer(const DrivenViewer&) = delete;
  DrivenViewer& operator=(const DrivenViewer&) = delete;
  ~DrivenViewer();

  /// What the program says is on its screen.
  [[nodiscard]] nlohmann::json status() const;
  /// Waits until the status is as asked; false after so long.
  bool waitFor(const std::function<bool(const nlohmann::json&)>& condition,
               double seconds = 60) const;
  /// Until the pictures and the whole truth are there.
  bool waitUntilComplete(double seconds = 120) const;

  void key(const std::string& name) const;
  void moveTo(int x, int y) const;
  void click(int x, int y) const;
  /// Presses the left button at one place and lets it go at another, some places between.
  void drag(int x0, int y0, int x1, int y1) const;
  void scroll(int steps) const;
  /// Types letters, digits, points and hyphens.
  void type(const std::string& text) const;
  void keyDown(const std::string& name) const;
  void keyUp(const std::string& name) const;
  /// Clicks on a control at a share of its width.
  void clickControl(const std::string& name, double share = 0.5) const;
  /// Drags a slider from one share of its width to another.
  void dragControl(const std::string& name, double from, double to) const;

  /// Waits for the program's end. @return its exit status, 128 + the signal's number; -1 after so
  /// long
  int waitForEnd(double seconds = 60);
  [[nodiscard]] std::string output() const;  ///< what it printed, both streams

 private:
  void tool(const std::string& arguments) const;
  [[nodiscard]] std::vector<int> control(const std::string& name) const;

  std::string display_;
  std::filesystem::path folder_;
  pid_t process_ = -1;
};

}  // namespace gnomon::test

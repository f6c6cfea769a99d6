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

  /// What the program says is on its screen: the JSON file beside the study that the key S saves.
  [[nodiscard]] nlohmann::json status() const;
  /// N of the last study that it saved, `out/ball/view/view-N`; 0 for none.
  [[nodiscard]] int lastSaved() const;
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
  void keyDown(const std::string& name) const;
  void keyUp(const std::string& name) const;
  /// Waits for the program's end. @return its exit status, 128 + the signal's number; -1 after so
  /// long
  int waitForEnd(double seconds = 60);
  [[nodiscard]] std::string output() const;  ///< what it printed, both streams

 private:
  void tool(const std::string& arguments) const;

  std::string display_;
  std::filesystem::path folder_;
  pid_t process_ = -1;
};

}  // namespace gnomon::test

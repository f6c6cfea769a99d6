#pragma once

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gnomon::test {

/// A headless Chromium with one page, driven by its DevTools protocol over a pair of pipes: keys
/// and the mouse are real ones. All calls throw std::runtime_error where the browser does not
/// answer within a minute, or answers with an error.
class Browser {
 public:
  /// @param folder  for its profile
  explicit Browser(const std::filesystem::path& folder);
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;
  ~Browser();

  /// Opens a file from disk and waits until it is loaded.
  void open(const std::filesystem::path& page, int width = 1200, int height = 1000);

  /// The value of a script's expression in the page; of a promise, what it gives.
  nlohmann::json evaluate(const std::string& expression);

  /// Presses and releases a key, "b" or "ArrowLeft", where the focus is.
  void key(const std::string& name);
  /// Moves the mouse there; coordinates in CSS pixels of the window.
  void moveMouse(double x, double y);
  void pressMouse(double x, double y);
  void releaseMouse(double x, double y);
  void wheel(double x, double y, double deltaY);

  /// A command of the protocol; its result.
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters = {});

  /// What the page wrote to its console as a warning or error, and what it threw.
  [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_; }
  /// The addresses that the page asked for, except those of data that it holds itself.
  [[nodiscard]] const std::vector<std::string>& requests() const { return requests_; }

 private:
  nlohmann::json nextMessage();
  void note(const nlohmann::json& event);
  void mouse(const char* type, double x, double y, const nlohmann::json& more);

  pid_t process_ = 0;
  int in_ = -1;
  int out_ = -1;
  int lastId_ = 0;
  bool loaded_ = false;
  std::string session_;
  std::string buffer_;
  std::vector<std::string> complaints_;
  std::vector<std::string> requests_;
};

}  // namespace gnomon::test

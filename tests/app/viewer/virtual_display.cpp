#include "app/viewer/virtual_display.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace gnomon::test {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

/// Starts a program with its output in a file. `prepare` runs in the child.
pid_t start(std::vector<std::string> words, const fs::path& output,
            const std::function<void()>& prepare) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("fork");
  if (process > 0) return process;
  const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  prepare();
  execvp(pointers.front(), pointers.data());
  _exit(127);
}

void endProcess(pid_t process) {
  if (process <= 0) return;
  kill(process, SIGKILL);
  waitpid(process, nullptr, 0);
}

}  // namespace

VirtualDisplay::VirtualDisplay() {
  int ends[2];
  if (pipe(ends) != 0) return;
  process_ = start({"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0", "1280x800x24",
                    "-nolisten", "tcp", "-noreset"},
                   "/dev/null", [&] { close(ends[0]); });
  close(ends[1]);
  char letter = 0;
  std::string number;
  while (read(ends[0], &letter, 1) == 1 && letter != '\n') number += letter;
  close(ends[0]);
  if (!number.empty()) name_ = ":" + number;
}

VirtualDisplay::~VirtualDisplay() {
  if (process_ <= 0) return;
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
}

DrivenViewer::DrivenViewer(const VirtualDisplay& display, fs::path folder,
                           std::vector<std::string> arguments, std::vector<std::string> environment)
    : display_(display.name()), folder_(std::move(folder)) {
  std::vector<std::string> words = {GNOMON_PROGRAM, "view"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  environment.push_back("DISPLAY=" + display_);
  process_ = start(words, folder_ / "viewer.log", [&] {
    if (chdir(folder_.c_str()) != 0) _exit(127);
    for (std::string& variable : environment) putenv(variable.data());
  });
  // Keys that are pressed before the window is there are lost.
  (void)std::system(fmt::format("DISPLAY={} timeout 60 xdotool search --sync --onlyvisible --name "
                                "Gnomon >/dev/null 2>&1",
                                display_)
                        .c_str());
}

DrivenViewer::~DrivenViewer() {
  endProcess(process_);
}

int DrivenViewer::lastSaved() const {
  int number = 0;
  while (fs::exists(folder_ / fmt::format("out/ball/view/view-{}.json", number + 1))) ++number;
  return number;
}

nlohmann::json DrivenViewer::status() const {
  const int before = lastSaved();
  const auto end = Clock::now() + std::chrono::seconds(20);
  key("s");
  while (lastSaved() == before && Clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  std::ifstream file(folder_ / fmt::format("out/ball/view/view-{}.json", lastSaved()));
  return lastSaved() == before ? nlohmann::json() : nlohmann::json::parse(file, nullptr, false);
}

bool DrivenViewer::waitFor(const std::function<bool(const nlohmann::json&)>& condition,
                           double seconds) const {
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (Clock::now() < end) {
    const nlohmann::json now = status();
    if (now.is_object() && condition(now)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

bool DrivenViewer::waitUntilComplete(double seconds) const {
  return waitFor([](const nlohmann::json& now) { return now.at("complete").get<bool>(); }, seconds);
}

void DrivenViewer::tool(const std::string& arguments) const {
  const std::string command =
      fmt::format("DISPLAY={} xdotool {} >/dev/null 2>&1", display_, arguments);
  if (std::system(command.c_str()) != 0) throw std::runtime_error(command);
  // The program reads input once a frame: what comes and goes within one would not be seen.
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
}

void DrivenViewer::key(const std::string& name) const {
  tool("keydown " + name);
  tool("keyup " + name);
}

void DrivenViewer::keyDown(const std::string& name) const {
  tool("keydown " + name);
}

void DrivenViewer::keyUp(const std::string& name) const {
  tool("keyup " + name);
}

void DrivenViewer::moveTo(int x, int y) const {
  tool(fmt::format("mousemove {} {}", x, y));
}

void DrivenViewer::click(int x, int y) const {
  moveTo(x, y);
  tool("mousedown 1");
  tool("mouseup 1");
}

void DrivenViewer::drag(int x0, int y0, int x1, int y1) const {
  constexpr int steps = 4;
  moveTo(x0, y0);
  tool("mousedown 1");
  for (int i = 1; i <= steps; ++i) {
    moveTo(x0 + (x1 - x0) * i / steps, y0 + (y1 - y0) * i / steps);
  }
  tool("mouseup 1");
}

void DrivenViewer::scroll(int steps) const {
  for (int i = 0; i < std::abs(steps); ++i) tool(steps > 0 ? "click 4" : "click 5");
}

int DrivenViewer::waitForEnd(double seconds) {
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (Clock::now() < end) {
    int result = 0;
    if (waitpid(process_, &result, WNOHANG) == process_) {
      process_ = -1;
      return WIFEXITED(result) ? WEXITSTATUS(result) : 128 + WTERMSIG(result);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return -1;
}

std::string DrivenViewer::output() const {
  std::ifstream file(folder_ / "viewer.log");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace gnomon::test

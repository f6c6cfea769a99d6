#include "end_to_end/support/browser.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <stdexcept>

namespace gnomon::test {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

struct Pipe {
  int read = -1;
  int write = -1;
};

Pipe makePipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error(std::strerror(errno));
  // Out of the way of 3 and 4, where the browser looks for its own ends.
  Pipe result{::fcntl(ends[0], F_DUPFD_CLOEXEC, 10), ::fcntl(ends[1], F_DUPFD_CLOEXEC, 10)};
  ::close(ends[0]);
  ::close(ends[1]);
  return result;
}

pid_t startChromium(const fs::path& folder, int commands, int answers) {
  // Without its sandbox, which root in a container cannot have; it opens our own pages only.
  std::vector<std::string> words = {"chromium",
                                    "--headless",
                                    "--no-sandbox",
                                    "--disable-gpu",
                                    "--disable-dev-shm-usage",
                                    "--disable-background-networking",
                                    "--disable-component-update",
                                    "--no-first-run",
                                    "--hide-scrollbars",
                                    "--remote-debugging-pipe",
                                    "--user-data-dir=" + (folder / "profile").string(),
                                    "about:blank"};
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, commands, 3);
  posix_spawn_file_actions_adddup2(&actions, answers, 4);
  pid_t process = 0;
  const int failure =
      posix_spawnp(&process, "chromium", &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) {
    throw std::runtime_error(std::string("chromium cannot be started (packages.txt has it): ") +
                             std::strerror(failure));
  }
  return process;
}

bool endsWithin(pid_t process, int milliseconds) {
  for (int waited = 0; waited < milliseconds; waited += 20) {
    if (::waitpid(process, nullptr, WNOHANG) != 0) return true;
    ::usleep(20'000);
  }
  return false;
}

}  // namespace

Browser::Browser(const fs::path& folder) {
  const Pipe commands = makePipe();
  const Pipe answers = makePipe();
  process_ = startChromium(folder, commands.read, answers.write);
  ::close(commands.read);
  ::close(answers.write);
  in_ = commands.write;
  out_ = answers.read;
  const json target = call("Target.createTarget", {{"url", "about:blank"}});
  session_ = call("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}})
                 .at("sessionId");
  for (const char* domain : {"Page.enable", "Runtime.enable", "Log.enable", "Network.enable"}) {
    call(domain);
  }
}

Browser::~Browser() {
  const std::string farewell = R"({"id":0,"method":"Browser.close"})";
  ::signal(SIGPIPE, SIG_IGN);
  (void)!::write(in_, farewell.c_str(), farewell.size() + 1);
  if (!endsWithin(process_, 5000)) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  ::close(in_);
  ::close(out_);
}

json Browser::nextMessage() {
  constexpr int patience = 60'000;
  std::size_t end = 0;
  while ((end = buffer_.find('\0')) == std::string::npos) {
    pollfd waiting{out_, POLLIN, 0};
    if (::poll(&waiting, 1, patience) <= 0) throw std::runtime_error("chromium does not answer");
    std::array<char, 65536> part{};
    const ssize_t length = ::read(out_, part.data(), part.size());
    if (length <= 0) throw std::runtime_error("chromium has ended");
    buffer_.append(part.data(), static_cast<std::size_t>(length));
  }
  json message = json::parse(buffer_.substr(0, end));
  buffer_.erase(0, end + 1);
  return message;
}

json Browser::call(const std::string& method, const json& parameters) {
  const int id = ++lastId_;
  json command = {{"id", id}, {"method", method}};
  if (!parameters.is_null()) command["params"] = parameters;
  if (!session_.empty()) command["sessionId"] = session_;
  const std::string text = command.dump();
  for (std::size_t done = 0; done < text.size() + 1;) {
    const ssize_t length = ::write(in_, text.c_str() + done, text.size() + 1 - done);
    if (length <= 0) throw std::runtime_error("chromium takes no command");
    done += static_cast<std::size_t>(length);
  }
  while (true) {
    const json message = nextMessage();
    if (message.value("id", 0) != id) {
      note(message);
    } else if (message.contains("error")) {
      throw std::runtime_error(method + ": " + message.at("error").dump());
    } else {
      return message.at("result");
    }
  }
}

void Browser::note(const json& event) {
  const std::string method = event.value("method", "");
  const json parameters = event.value("params", json::object());
  if (method == "Page.loadEventFired") loaded_ = true;
  if (method == "Runtime.exceptionThrown") {
    complaints_.push_back(parameters.at("exceptionDetails").dump());
  }
  if (method == "Runtime.consoleAPICalled") {
    const std::string type = parameters.at("type");
    if (type == "error" || type == "warning" || type == "assert") {
      complaints_.push_back(parameters.at("args").dump());
    }
  }
  if (method == "Log.entryAdded") {
    const std::string level = parameters.at("entry").at("level");
    if (level == "error" || level == "warning") {
      complaints_.push_back(parameters.at("entry").at("text"));
    }
  }
  if (method == "Network.requestWillBeSent") {
    const std::string url = parameters.at("request").at("url");
    if (url.rfind("data:", 0) != 0) requests_.push_back(url);
  }
}

void Browser::open(const fs::path& page, int width, int height) {
  call("Emulation.setDeviceMetricsOverride",
       {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", width < 600}});
  loaded_ = false;
  call("Page.navigate", {{"url", "file://" + page.string()}});
  while (!loaded_) note(nextMessage());
}

json Browser::evaluate(const std::string& expression) {
  const json result =
      call("Runtime.evaluate",
           {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
  if (result.contains("exceptionDetails")) {
    throw std::runtime_error(expression + ": " + result.at("exceptionDetails").dump());
  }
  return result.at("result").value("value", json());
}

void Browser::key(const std::string& name) {
  json parameters = {{"type", "keyDown"}, {"key", name}};
  if (name.size() == 1) parameters["text"] = name;
  call("Input.dispatchKeyEvent", parameters);
  parameters["type"] = "keyUp";
  parameters.erase("text");
  call("Input.dispatchKeyEvent", parameters);
}

void Browser::mouse(const char* type, double x, double y, const json& more) {
  json parameters = {{"type", type}, {"x", x}, {"y", y}};
  parameters.update(more);
  call("Input.dispatchMouseEvent", parameters);
}

void Browser::moveMouse(double x, double y) {
  mouse("mouseMoved", x, y, json::object());
}

void Browser::pressMouse(double x, double y) {
  mouse("mousePressed", x, y, {{"button", "left"}, {"clickCount", 1}});
}

void Browser::releaseMouse(double x, double y) {
  mouse("mouseReleased", x, y, {{"button", "left"}, {"clickCount", 1}});
}

void Browser::wheel(double x, double y, double deltaY) {
  mouse("mouseWheel", x, y, {{"deltaX", 0}, {"deltaY", deltaY}});
}

}  // namespace gnomon::test

#include "end_to_end/support/program.h"
#include "support/columns_study.h"

#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace gnomon::test {
namespace fs = std::filesystem;
namespace {

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> result;
  for (std::string& text : strings) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

/// This process's variables with others in their place.
std::vector<std::string> mergedEnvironment(const std::vector<std::string>& changes) {
  std::vector<std::string> result = changes;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('=') + 1);
    const bool changed =
        std::any_of(changes.begin(), changes.end(),
                    [&](const std::string& change) { return change.rfind(name, 0) == 0; });
    if (!changed) result.push_back(text);
  }
  return result;
}

/// The variables with a cache for one run alone, unless they name one.
std::vector<std::string> withCache(const fs::path& folder, std::vector<std::string> environment) {
  const bool hasOne = std::any_of(
      environment.begin(), environment.end(),
      [](const std::string& variable) { return variable.starts_with("GNOMON_CACHE="); });
  if (hasOne) return environment;
  std::string own = (folder / ".cache-XXXXXX").string();
  if (mkdtemp(own.data()) == nullptr) throw std::runtime_error(own + ": cannot be made");
  environment.push_back("GNOMON_CACHE=" + own);
  return environment;
}

pid_t start(const fs::path& folder, const std::vector<std::string>& arguments,
            const std::vector<std::string>& environment, const fs::path& out, const fs::path& err) {
  std::vector<std::string> words = {GNOMON_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return startCommand(folder, words, environment, out, err);
}

}  // namespace

int startCommand(const fs::path& folder, std::vector<std::string> words,
                 const std::vector<std::string>& environment, const fs::path& out,
                 const fs::path& err) {
  std::vector<std::string> variables = mergedEnvironment(withCache(folder, environment));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), flags, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), flags, 0600);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  pid_t process = 0;
  const int failure = posix_spawnp(&process, words.front().c_str(), &actions, &attributes,
                                   pointers(words).data(), pointers(variables).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw std::runtime_error(words.front() + ": cannot be started");
  return process;
}

int endOf(int process) {
  int state = 0;
  waitpid(process, &state, 0);
  return WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
}

Outcome runProgram(const fs::path& folder, const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment) {
  const fs::path out = folder / ".stdout";
  const fs::path err = folder / ".stderr";
  const int status = endOf(start(folder, arguments, environment, out, err));
  Outcome outcome{status, content(out), content(err)};
  fs::remove(out);
  fs::remove(err);
  return outcome;
}

void runAndKill(const fs::path& folder, const std::vector<std::string>& arguments,
                int milliseconds) {
  const pid_t process = start(folder, arguments, {}, "/dev/null", "/dev/null");
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  kill(process, SIGKILL);
  waitpid(process, nullptr, 0);
}

bool runAndKillWhen(const fs::path& folder, const std::vector<std::string>& arguments,
                    const std::vector<std::string>& environment,
                    const std::function<bool()>& holds) {
  const pid_t process = start(folder, arguments, environment, "/dev/null", "/dev/null");
  for (int i = 0; i < 12000 && !holds(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  kill(process, SIGKILL);
  int state = 0;
  waitpid(process, &state, 0);
  return WIFSIGNALED(state);
}

namespace {

/// The first channels of an image, beside each other in each pixel.
GreyImage readChannels(const fs::path& path, int channels) {
  const auto image = OIIO::ImageInput::open(path.string());
  if (!image) throw std::runtime_error(path.string() + ": " + OIIO::geterror());
  const OIIO::ImageSpec spec = image->spec();
  GreyImage read{
      spec.width, spec.height,
      std::vector<unsigned char>(spec.image_pixels() * static_cast<std::size_t>(channels))};
  if (!image->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, read.pixels.data())) {
    throw std::runtime_error(path.string() + ": " + image->geterror());
  }
  return read;
}

}  // namespace

GreyImage readGrey(const fs::path& path) {
  return readChannels(path, 1);
}

std::vector<unsigned char> readColours(const fs::path& path) {
  return readChannels(path, 3).pixels;
}

void EndToEnd::write(const std::string& name, const std::string& text) const {
  std::ofstream(file(name), std::ios::binary) << text;
}

std::string EndToEnd::read(const std::string& name) const {
  return content(file(name));
}

void EndToEnd::runStudy(const std::string& name, const std::string& text,
                        const std::vector<std::string>& options) const {
  write(name + ".toml", text);
  std::vector<std::string> arguments = {"run", name + ".toml"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome outcome = gnomon(arguments);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  ASSERT_EQ(outcome.err, "");
}

nlohmann::json EndToEnd::summary(const std::string& name, const std::string& out) const {
  return nlohmann::json::parse(content(file(out) / name / "summary.json"));
}

GreyImage EndToEnd::mask(const std::string& study, const std::string& name) const {
  return readGrey(file("out") / study / "masks" / (name + ".png"));
}

std::vector<std::string> EndToEnd::filesBelow(const std::string& name) const {
  std::vector<std::string> files;
  if (!fs::exists(file(name))) return files;
  for (const auto& entry : fs::recursive_directory_iterator(file(name))) {
    if (!entry.is_directory())
      files.push_back(entry.path().lexically_relative(file(name)).string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

fs::path SharedRuns::folderOfSuite() {
  static struct Folders {
    ~Folders() {
      for (const auto& [suite, folder] : of) fs::remove_all(folder);
    }
    std::map<std::string, fs::path> of;
  } folders;
  fs::path& folder = folders.of[testing::UnitTest::GetInstance()->current_test_suite()->name()];
  if (folder.empty()) folder = made();
  return folder;
}

nlohmann::json resultOf(const nlohmann::json& summary, const std::string& method,
                        const std::string& light, const std::string& view,
                        const std::string& region, const std::string& answer) {
  for (const nlohmann::json& result : summary.at("results")) {
    if (result.at("method") == method && result.at("light") == light && result.at("view") == view &&
        result.at("region") == region && result.at("answer") == answer) {
      return result;
    }
  }
  throw std::runtime_error("no result of " + method + " under " + light + " in " + view);
}

nlohmann::json lastingPart(nlohmann::json summary) {
  summary.erase("timings");
  summary.erase("cache");
  summary.at("study").erase("command");
  summary.at("truth").erase("bvh_bytes");
  for (nlohmann::json& cost : summary.at("cost")) {
    for (const char* key : {"frame_ms", "still_ms", "frame_ratio", "frame_kept_since"})
      cost.erase(key);
  }
  return summary;
}

std::string smallStudy() {
  return smallestStudy("small") + R"(
[[light]]
name = "evening"
azimuth = 20
elevation = 30

[[method]]
name = "unshadowed"

[[method]]
name = "max-forsyth"
)";
}

std::string onSphere(const std::string& study) {
  return replaced(replaced(study, "shape = \"plane\"", "shape = \"sphere\"\ncurvature = 0.02"),
                  "quads = [4, 4]", "quads = [16, 16]");
}

}  // namespace gnomon::test

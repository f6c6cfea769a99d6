#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/replaced.h"
#include "support/temporary_folder.h"

namespace gnomon::test {

/// What a run of the program left behind.
struct Outcome {
  int status = 0;  ///< exit status; 128 + the signal's number where a signal ended it
  std::string out;
  std::string err;
};

/// Runs the program and waits for its end.
/// @param environment  variables NAME=VALUE on top of this process's own. Unless GNOMON_CACHE is
///   among them, the program has a cache of its own, empty: no run takes up what another one left
Outcome runProgram(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment = {});

/// Starts a command, which is looked for as the shell does, and goes on. Its output goes to files,
/// and signals have their usual effect on it, whatever they have here.
/// @param words        the command, then its arguments
/// @param environment  as runProgram's
/// @return its process id: see endOf
int startCommand(const std::filesystem::path& folder, std::vector<std::string> words,
                 const std::vector<std::string>& environment, const std::filesystem::path& out,
                 const std::filesystem::path& err);

/// Waits for the end of a process: its exit status; 128 + the signal's number where one ended it.
int endOf(int process);

/// Runs the program and kills it after a while, as a power cut would.
void runAndKill(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                int milliseconds);

/// Likewise, as soon as something holds, or after a minute.
/// @return false where it had come to its end before
bool runAndKillWhen(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                    const std::vector<std::string>& environment,
                    const std::function<bool()>& holds);

/// The masks' grey values in a PNG, row by row from the top: 255 lit, 0 shadowed, 128 no sample.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> pixels;
};

/// @throws std::runtime_error for an image that is not whole
GreyImage readGrey(const std::filesystem::path& path);

/// A PNG's colours: red, green and blue of each pixel, row by row from the top.
/// @throws as readGrey
std::vector<unsigned char> readColours(const std::filesystem::path& path);

/// A test that runs studies in a folder of its own.
class EndToEnd : public TemporaryFolder {
 protected:
  EndToEnd() = default;
  explicit EndToEnd(std::filesystem::path shared) : TemporaryFolder(std::move(shared)) {}
  void write(const std::string& name, const std::string& text) const;
  [[nodiscard]] std::string read(const std::string& name) const;

  [[nodiscard]] Outcome gnomon(const std::vector<std::string>& arguments,
                               const std::vector<std::string>& environment = {}) const {
    return runProgram(folder(), arguments, environment);
  }
  /// Runs a study that is expected to pass; its folder is `out/NAME`.
  void runStudy(const std::string& name, const std::string& text,
                const std::vector<std::string>& options = {}) const;
  [[nodiscard]] nlohmann::json summary(const std::string& name,
                                       const std::string& out = "out") const;
  /// A mask of a study with plain names: `view_light_method`.
  [[nodiscard]] GreyImage mask(const std::string& study, const std::string& name) const;
  /// All files below a folder, relative to it, sorted.
  [[nodiscard]] std::vector<std::string> filesBelow(const std::string& name) const;
};

/// A test in the folder of its whole suite: what `prepare` runs there once, all of its tests read.
class SharedRuns : public EndToEnd {
 protected:
  SharedRuns() : EndToEnd(folderOfSuite()) {}
  void SetUp() override {
    if (!std::filesystem::exists(file(".prepared"))) prepare();
    write(".prepared", "");
  }
  virtual void prepare() = 0;

 private:
  static std::filesystem::path folderOfSuite();
};

/// The entry of `results` for a method, light, view and region.
nlohmann::json resultOf(const nlohmann::json& summary, const std::string& method,
                        const std::string& light, const std::string& view,
                        const std::string& region = "all", const std::string& answer = "drawn");

/// A summary without its command and what two runs of one study do not share: times, memory, and
/// what a cache had.
nlohmann::json lastingPart(nlohmann::json summary);

/// A study of a second's quarter: columns on a plane, one light, one camera.
std::string smallStudy();

/// The same study on a part of a sphere, where curvature and elevation differ from sample to
/// sample.
std::string onSphere(const std::string& study);

}  // namespace gnomon::test

#include "app/viewer/viewer_window.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "support/columns_study.h"

namespace gnomon::test {
namespace fs = std::filesystem;

std::string ballStudy() {
  return sphereStudy("ball") + R"(
[truth]
step = 0.25

[[view]]
type = "camera"
width = 200
height = 200
eye = [0, 0, 140]
fov = 30

[[light]]
azimuth = 20
elevation = 30

[[method]]
name = "max-forsyth"

[[method]]
name = "onoue-2004"
)";
}

void ViewerWindow::SetUp() {
  EndToEnd::SetUp();
  ASSERT_FALSE(display_.name().empty()) << "no Xvfb: install the packages of packages.txt";
  write("ball.toml", ballStudy());
}

DrivenViewer ViewerWindow::open(std::vector<std::string> arguments,
                                const std::vector<std::string>& environment) const {
  arguments.insert(arguments.begin(), "ball.toml");
  return {display_, folder(), arguments, environment};
}

std::size_t differingPixels(const fs::path& a, const fs::path& b) {
  const auto first = readColours(a);
  const auto second = readColours(b);
  if (first.size() != second.size()) throw std::runtime_error("pictures of different sizes");
  std::size_t count = 0;
  for (std::size_t i = 0; i < first.size(); i += 3) {
    count += std::equal(&first[i], &first[i] + 3, &second[i]) ? 0 : 1;
  }
  return count;
}

bool appears(const fs::path& path) {
  for (int wait = 0; wait < 200 && !fs::exists(path); ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return fs::exists(path);
}

}  // namespace gnomon::test

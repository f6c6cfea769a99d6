#include "study/environment.h"

#include <fstream>

#include "common/parallel.h"
#include "render/frame_timer.h"
#include "surface/limit_surface.h"
#include "truth/micro_scene.h"

namespace gnomon {

std::string processorName() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

EnvironmentRecord describeEnvironment(const GlContext& gl) {
  EnvironmentRecord environment;
  environment.gnomonVersion = GNOMON_VERSION;
  environment.commit = GNOMON_COMMIT;
  environment.cpu = processorName();
  environment.threads = static_cast<int>(threadCount());
  environment.glRenderer = gl.renderer();
  environment.glVersion = gl.version();
  environment.embreeVersion = MicroScene::embreeVersion();
  environment.openSubdivVersion = openSubdivVersion();
  environment.frameClock = frameClockName(frameClockOf(environment.glRenderer));
  return environment;
}

StudyRecord startRecord(const StudySpec& study, const GlContext& gl) {
  StudyRecord record;
  record.environment = describeEnvironment(gl);
  record.name = study.name;
  record.title = study.title;
  record.source = study.source;
  record.file = study.file.string();
  return record;
}

}  // namespace gnomon

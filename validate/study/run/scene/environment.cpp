#include "study/run/scene/environment.h"

#include <fmt/core.h>

#include <fstream>
#include <optional>

#include "common/error.h"
#include "common/parallel.h"
#include "render/frame_timer.h"
#include "surface/limit_surface.h"
#include "truth/micro_scene.h"

namespace gnomon::study {

namespace {

/// The first value of a key in the kernel's description of the processors; none without it.
std::optional<std::string> processorValue(const std::string& key) {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    const std::size_t colon = line.find(": ");
    if (line.rfind(key, 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return std::nullopt;
}

}  // namespace

std::string processorName() {
  return processorValue("model name").value_or("unknown");
}

std::string processorFeatures() {
  const auto features = processorValue("flags");
  return features ? *features : processorValue("Features").value_or("");
}

namespace {

const char* boundText(horizon::RadiusBound bound) {
  switch (bound) {
    case horizon::RadiusBound::stated:
      return "the study states it";
    case horizon::RadiusBound::leaves:
      return "the longest way on which a ray to the light meets the relief";
    case horizon::RadiusBound::border:
      return "a ray to the light does not leave the relief before the border, which is so far";
    case horizon::RadiusBound::quarterTurn:
      return "a ray to the light does not leave the relief before the surface has turned by 90°";
    case horizon::RadiusBound::size:
      return "a ray to the light does not leave the relief, and the surface is as large";
    case horizon::RadiusBound::tile:
      return "a ray to the light does not leave the relief, and the map that repeats is as large";
    case horizon::RadiusBound::unlit:
      return "no light reaches the surface";
  }
  throw InternalError("search radius: not one of its seven bounds");
}

std::string radiusReason(const StudySpec& study) {
  const std::string text = boundText(study.radius.bound);
  const bool isOfLight = study.radius.bound != horizon::RadiusBound::stated &&
                         study.radius.bound != horizon::RadiusBound::unlit;
  return isOfLight ? fmt::format("{} ({})", text, study.lights.at(study.radius.light).name) : text;
}

}  // namespace

std::string programVersion() {
  return GNOMON_VERSION;
}

std::string programCommit() {
  return GNOMON_COMMIT;
}

EnvironmentRecord describeEnvironment(const render::GlContext& gl) {
  EnvironmentRecord environment;
  environment.gnomonVersion = programVersion();
  environment.commit = programCommit();
  environment.cpu = processorName();
  environment.threads = static_cast<int>(threadCount());
  environment.glRenderer = gl.driver().renderer;
  environment.glVersion = gl.driver().version;
  environment.embreeVersion = truth::MicroScene::embreeVersion();
  environment.openSubdivVersion = surface::openSubdivVersion();
  environment.frameClock = render::frameClockName(render::frameClockOf(environment.glRenderer));
  return environment;
}

std::vector<std::string> atlasViewsOf(const StudySpec& study) {
  std::vector<std::string> names;
  for (const ViewSpec& view : study.views) {
    if (cameraOf(view) == nullptr) names.push_back(view.name);
  }
  return names;
}

StudyRecord startRecord(const StudySpec& study, const render::GlContext& gl) {
  StudyRecord record;
  record.environment = describeEnvironment(gl);
  record.name = study.name;
  record.title = study.title;
  record.source = study.source;
  record.file = study.file.string();
  record.atlasViews = atlasViewsOf(study);
  record.radius = {study.radius.texels, radiusReason(study)};
  return record;
}

}  // namespace gnomon::study

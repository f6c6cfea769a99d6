#include "model/light_angles.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "common/error.h"

namespace gnomon::app {

namespace {

/// To a thousandth of a degree.
double rounded(double degrees) {
  return std::round(1000 * degrees) / 1000;
}

/// Four numbers with commas between them.
std::optional<std::array<double, 4>> fourNumbers(const std::string& text) {
  std::array<double, 4> numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && (at == end || *at++ != ',')) return std::nullopt;
    const auto [rest, failure] = std::from_chars(at, end, numbers.at(i));
    if (failure != std::errc() || !std::isfinite(numbers.at(i))) return std::nullopt;
    at = rest;
  }
  return at == end ? std::optional(numbers) : std::nullopt;
}

/// Whether a path's end is its start after whole turns.
bool isClosed(const LightPath& path) {
  const double change = path.toAzimuth - path.fromAzimuth;
  return change != 0 && std::remainder(change, 360) == 0 && path.toElevation == path.fromElevation;
}

}  // namespace

LightAngles dragged(const LightAngles& angles, double azimuthChange, double elevationChange) {
  const double azimuth = rounded(angles.azimuth + azimuthChange);
  const double within = rounded(azimuth - 360 * std::floor(azimuth / 360));
  return {within < 360 ? within : 0,
          std::clamp(rounded(angles.elevation + elevationChange), -90.0, 90.0), angles.radius};
}

LightAngles lightAt(const LightPath& path, int frame, double radius) {
  const int steps = isClosed(path) ? path.frames : path.frames - 1;
  const double t = steps == 0 ? 0 : static_cast<double>(frame) / steps;
  return dragged({path.fromAzimuth, path.fromElevation, radius},
                 t * (path.toAzimuth - path.fromAzimuth),
                 t * (path.toElevation - path.fromElevation));
}

LightPath parsePath(const std::string& text, const LightAngles& light, int frames) {
  if (text == "around") {
    return {light.azimuth, light.elevation, light.azimuth + 360, light.elevation, frames};
  }
  const auto numbers = fourNumbers(text);
  const auto fits = [](double azimuth, double elevation) {
    return std::abs(azimuth) <= 3600 && std::abs(elevation) <= 90;
  };
  if (!numbers || !fits((*numbers)[0], (*numbers)[1]) || !fits((*numbers)[2], (*numbers)[3])) {
    throw UsageError(
        fmt::format("--light-path {}: around, or azimuth and elevation of the start and of the "
                    "end, degrees, as 165,24,20,60, expected",
                    text));
  }
  const auto& [fromAzimuth, fromElevation, toAzimuth, toElevation] = *numbers;
  return {fromAzimuth, fromElevation, toAzimuth, toElevation, frames};
}

Camera orbited(const Camera& camera, double azimuth, double elevation) {
  const Vec3 offset = camera.eye - camera.target;
  const double distance = glm::length(offset);
  const Vec3 up = glm::normalize(camera.up);
  const Vec3 level = offset - glm::dot(offset, up) * up;
  const double run = glm::length(level);
  // Over a pole there is no azimuth; no view is made of such a camera.
  if (!(run > 1e-12 * distance)) return camera;
  const double before = std::atan2(glm::dot(offset, up), run);
  const double highest = std::max(radians(89), std::abs(before));
  const double after = std::clamp(before + elevation, -highest, highest);
  const Vec3 forward = level / run;
  const Vec3 turned = std::cos(azimuth) * forward + std::sin(azimuth) * glm::cross(up, forward);
  Camera moved = camera;
  moved.eye = camera.target + distance * (std::cos(after) * turned + std::sin(after) * up);
  return moved;
}

Camera zoomed(const Camera& camera, double factor, const ZoomRange& range) {
  const Vec3 offset = camera.eye - camera.target;
  const double distance = glm::length(offset);
  if (!(distance > 0)) return camera;
  const double wanted = std::clamp(factor * distance, range.nearest, range.farthest);
  Camera moved = camera;
  moved.eye = camera.target + wanted / distance * offset;
  return moved;
}

}  // namespace gnomon::app

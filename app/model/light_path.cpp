#include "model/light_path.h"

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <cmath>

#include "common/error.h"

namespace gnomon::app {
namespace {

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

}  // namespace

bool isClosed(const LightPath& path) {
  const double change = path.toAzimuth - path.fromAzimuth;
  return change != 0 && std::remainder(change, 360) == 0 && path.toElevation == path.fromElevation;
}

LightAngles lightAt(const LightPath& path, int frame, double radius) {
  const int steps = isClosed(path) ? path.frames : path.frames - 1;
  const double t = steps == 0 ? 0 : static_cast<double>(frame) / steps;
  return dragged({path.fromAzimuth, path.fromElevation, radius},
                 t * (path.toAzimuth - path.fromAzimuth),
                 t * (path.toElevation - path.fromElevation));
}

std::optional<int> frameAt(const LightPath& path, double seconds) {
  const double frame = std::floor(seconds * pathFramesPerSecond);
  return frame >= 0 && frame < path.frames ? std::optional(static_cast<int>(frame)) : std::nullopt;
}

LightPath turnFrom(const LightAngles& light, int frames) {
  return {light.azimuth, light.elevation, light.azimuth + 360, light.elevation, frames};
}

LightPath withEnd(const LightPath& path, const LightAngles& light) {
  LightPath changed = path;
  changed.toAzimuth = path.fromAzimuth + std::remainder(light.azimuth - path.fromAzimuth, 360);
  changed.toElevation = light.elevation;
  return changed;
}

LightPath parsePath(const std::string& text, const LightAngles& light, int frames) {
  if (text == "around") return turnFrom(light, frames);
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

std::string pathText(const LightPath& path) {
  if (isClosed(path) && std::abs(path.toAzimuth - path.fromAzimuth) == 360) {
    return fmt::format("once around, from azimuth {:.4g}° at elevation {:.4g}°", path.fromAzimuth,
                       path.fromElevation);
  }
  return fmt::format("from azimuth {:.4g}°, elevation {:.4g}° to {:.4g}°, {:.4g}°",
                     path.fromAzimuth, path.fromElevation, path.toAzimuth, path.toElevation);
}

}  // namespace gnomon::app

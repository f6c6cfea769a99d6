#include "viewer/window/path_recording.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/error.h"
#include "image/images.h"

namespace gnomon::app {
namespace fs = std::filesystem;
namespace {

constexpr const char* filmName = "light.webm";

/// Pictures of two recordings must not be mixed in one film.
void makeEmptyFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && fs::is_empty(folder, error)) return;
  throw InputError(
      error ? fmt::format("{}: cannot create the folder: {}", folder.string(), error.message())
            : fmt::format("{}: holds files, a new or an empty folder expected", folder.string()));
}

}  // namespace

PathRecording::PathRecording(const LightPath& path, double radius, fs::path folder)
    : path_(path), radius_(radius), folder_(std::move(folder)) {
  makeEmptyFolder(folder_);
}

LightAngles PathRecording::light() const {
  return lightAt(path_, std::min(frame_, path_.frames - 1), radius_);
}

void PathRecording::add(const image::Image& picture) {
  if (frame_ == 0) {
    width_ = picture.width;
    height_ = picture.height;
  }
  if (picture.width != width_ || picture.height != height_) {
    throw InputError("the recording ended: the window has changed its size");
  }
  image::writePng(folder_ / fmt::format("frame-{:04}.png", frame_ + 1), picture);
  ++frame_;
  if (!hasAllFrames()) return;
  if (!hasFfmpeg()) {
    note_ = "no film, since ffmpeg was not found";
    return;
  }
  try {
    film_.emplace(folder_, "frame-%04d.png", filmName);
  } catch (const std::exception& error) {
    note_ = fmt::format("no film: {}", error.what());
  }
}

bool PathRecording::isDone() {
  if (film_) {
    const auto outcome = film_->poll();
    if (!outcome) return false;
    film_.reset();
    hasFilm_ = outcome->isThere;
    if (!hasFilm_) note_ = fmt::format("no film: ffmpeg: {}", outcome->error);
  }
  return hasAllFrames();
}

std::string PathRecording::progress() const {
  if (film_) return "making the film";
  return fmt::format("frame {} of {}", std::min(frame_ + 1, path_.frames), path_.frames);
}

std::string PathRecording::outcome() const {
  const std::string film = hasFilm_ ? fmt::format(" and {}", filmName) : "";
  const std::string note = film_ ? "; making the film" : note_.empty() ? "" : "; " + note_;
  return fmt::format("saved {} {}{} in {}{}", frame_, frame_ == 1 ? "picture" : "pictures", film,
                     folder_.string(), note);
}

}  // namespace gnomon::app

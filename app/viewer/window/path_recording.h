#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "image/image.h"
#include "model/light_path.h"
#include "viewer/window/film.h"

namespace gnomon::app {

/// Records what the panes show along a light path: `frame-0001.png` and so on in a folder, each
/// whole or not there, and `light.webm` where `ffmpeg` is. Asks for a light, is given the picture
/// under it, and so on to the last frame.
class PathRecording {
 public:
  /// @param radius  of the light's disc, degrees
  /// @param folder  that is made, if it is not there yet
  /// @throws InputError for a folder that holds something, or cannot be made
  PathRecording(const LightPath& path, double radius, std::filesystem::path folder);

  /// The light of the frame that is wanted.
  [[nodiscard]] LightAngles light() const;
  /// Whether all pictures are there.
  [[nodiscard]] bool hasAllFrames() const { return frame_ == path_.frames; }
  /// Writes the picture of the frame that is wanted; after the last one the film is begun.
  /// @throws InputError where it cannot be written, or has another size than the first
  void add(const image::Image& picture);
  /// Whether there is nothing more to wait for.
  bool isDone();

  /// "frame 3 of 48", "making the film".
  [[nodiscard]] std::string progress() const;
  /// What is there now: "saved 48 pictures and light.webm in out/ball/view/path-1", "saved 48
  /// pictures in out/ball/view/path-1; no film, since ffmpeg was not found".
  [[nodiscard]] std::string outcome() const;

 private:
  LightPath path_;
  double radius_;
  std::filesystem::path folder_;
  int frame_ = 0;  ///< from 0
  int width_ = 0, height_ = 0;
  std::optional<Film> film_;
  bool hasFilm_ = false;
  std::string note_;  ///< why there is no film
};

}  // namespace gnomon::app

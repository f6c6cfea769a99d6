#pragma once

#include <filesystem>
#include <optional>

namespace gnomon::app {

/// What a person asks for by keys and buttons, beside changes of the state.
struct Actions {
  bool saveStudy = false;
  bool savePicture = false;
  bool saveMasks = false;
  bool undo = false;
  bool redo = false;
  bool play = false;         ///< the light path, or to stop it
  bool record = false;       ///< it, or to stop that
  bool askForStudy = false;  ///< wants to type the path of another one
  bool close = false;
  std::optional<std::filesystem::path> open;  ///< another study

  Actions& operator+=(const Actions& other) {
    saveStudy = saveStudy || other.saveStudy;
    savePicture = savePicture || other.savePicture;
    saveMasks = saveMasks || other.saveMasks;
    undo = undo || other.undo;
    redo = redo || other.redo;
    play = play || other.play;
    record = record || other.record;
    askForStudy = askForStudy || other.askForStudy;
    close = close || other.close;
    if (other.open) open = other.open;
    return *this;
  }
};

}  // namespace gnomon::app

#include "viewer/session/study_opener.h"

#include <algorithm>
#include <chrono>

#include "common/error.h"
#include "common/lists.h"

namespace gnomon::app {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> studiesIn(const fs::path& folder) {
  std::vector<fs::path> studies;
  std::error_code error;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, error), end; !error && at != end;
       at.increment(error)) {
    if (at->path().extension() == ".toml") studies.push_back(folder / at->path().filename());
  }
  std::sort(studies.begin(), studies.end());
  return studies;
}

StudyOpener::Answer answerOf(const cli::ViewRequest& request) {
  try {
    return {openStudy(request), {}};
  } catch (const std::exception& error) {
    return {std::nullopt, error.what()};
  }
}

}  // namespace

std::vector<fs::path> studiesBeside(const cli::ViewRequest& request) {
  std::vector<fs::path> studies = {request.study};
  for (const fs::path& other : request.others) appendOnce(studies, other);
  for (const fs::path& other : studiesIn(request.study.parent_path())) appendOnce(studies, other);
  return studies;
}

void StudyOpener::open(const fs::path& study, cli::ViewRequest request) {
  if (answer_.valid()) return;
  opening_ = study.filename().string();
  appendOnce(request.others, request.study);
  request.study = study;
  request.show.clear();
  request.options.addedMethods.clear();
  answer_ = std::async(std::launch::async, [this, request = std::move(request)] {
    Answer answer = answerOf(request);
    wake_();
    return answer;
  });
}

std::optional<StudyOpener::Answer> StudyOpener::take() {
  if (!answer_.valid()) return std::nullopt;
  if (answer_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
  opening_.clear();
  return answer_.get();
}

}  // namespace gnomon::app

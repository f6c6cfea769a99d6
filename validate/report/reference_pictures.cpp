#include "report/reference_pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/files/atomic_file.h"
#include "image/images.h"
#include "image/mask_picture.h"

namespace gnomon::report {
namespace fs = std::filesystem;
namespace {

using Kind = study::PictureRecord::Kind;
constexpr const char* pictureFolder = "references";

/// Leaves only the samples that both have.
void keepCommon(Visibility& a, Visibility& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a.shares[i]) || std::isnan(b.shares[i])) a.shares[i] = b.shares[i] = noSample;
  }
}

/// The path of the signed difference of a row; empty where the run has none.
std::string differenceOf(const study::StudyRecord& record, const study::ReferencePictures& row) {
  for (const study::PanelRecord& panel : record.panels) {
    if (panel.view != row.view || panel.light != row.light) continue;
    for (const study::PictureRecord& picture : panel.pictures) {
      if (picture.kind == Kind::difference && picture.method == row.method) return picture.path;
    }
  }
  return "";
}

/// Copies what was kept and draws the change.
void drawChange(study::ReferencePictures& row, RunFolder& folder, const fs::path& old) {
  Visibility before = image::sharesOfDifference(old);
  Visibility after = image::sharesOfDifference(folder.path() / row.after);
  if (before.width != after.width || before.height != after.height) {
    row.note = fmt::format("{} has {} × {} pixels, this run {} × {}", old.string(), before.width,
                           before.height, after.width, after.height);
    return;
  }
  keepCommon(before, after);
  const std::string name = fs::path(row.after).stem().string();
  row.before = fmt::format("{}/{}_before.png", pictureFolder, name);
  row.change = fmt::format("{}/{}_change.png", pictureFolder, name);
  folder.write(row.before, readFile(old));
  folder.write(row.change, image::pngOf(image::shareDifferenceImage(after, before)));
}

}  // namespace

void keepReferencePictures(const study::StudyRecord& record, const fs::path& folder,
                           const fs::path& kept) {
  RunFolder pictures(kept, {""});
  pictures.clear();
  for (const study::PanelRecord& panel : record.panels) {
    for (const study::PictureRecord& picture : panel.pictures) {
      if (picture.kind != Kind::difference) continue;
      const fs::path path = picture.path;
      pictures.write(path.filename().string(), readFile(folder / path));
    }
  }
  pictures.finish();
}

std::vector<study::ReferencePictures> drawReferencePictures(const study::StudyRecord& record,
                                                            RunFolder& folder,
                                                            const fs::path& kept) {
  std::vector<study::ReferencePictures> rows;
  for (const study::Judgement& judgement : study::byOrigin(record.judgements).references) {
    const study::Gate& gate = judgement.gate;
    if (!judgement.isFault()) continue;
    const bool isThere =
        std::any_of(rows.begin(), rows.end(), [&](const study::ReferencePictures& row) {
          return row.method == gate.method && row.view == gate.view && row.light == gate.light;
        });
    if (isThere) continue;
    study::ReferencePictures row{gate.method, gate.view, gate.light, "", "", "", ""};
    row.after = differenceOf(record, row);
    if (row.after.empty()) continue;
    const fs::path old = kept / fs::path(row.after).filename();
    if (fs::exists(old)) {
      drawChange(row, folder, old);
    } else {
      row.note =
          "No picture was kept with the reference: --update-baseline --baseline-pictures "
          "keeps one.";
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace gnomon::report

#include "report/reference_pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "image/grey_picture.h"
#include "image/images.h"

namespace gnomon::report {
namespace fs = std::filesystem;
namespace {

using Kind = study::PictureRecord::Kind;
constexpr const char* pictureFolder = "references";

/// The method's answer in a colour of a signed difference, of which the red part is enough.
Shade shadeOf(float red, const fs::path& path) {
  const auto is = [&](const image::Rgb& colour) {
    return std::lround(255 * red) == static_cast<long>(colour[0]);
  };
  if (is(image::DifferenceColours::none)) return Shade::none;
  if (is(image::DifferenceColours::bothLit) || is(image::DifferenceColours::falseLight))
    return Shade::lit;
  if (is(image::DifferenceColours::bothShadowed) || is(image::DifferenceColours::falseShadow)) {
    return Shade::shadowed;
  }
  throw InputError(fmt::format("{}: a colour found that no signed difference has", path.string()));
}

/// Leaves only the samples that both have.
void keepCommon(Mask& a, Mask& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.samples[i] == Shade::none) b.samples[i] = Shade::none;
    if (b.samples[i] == Shade::none) a.samples[i] = Shade::none;
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

/// Whether a row's light has a disc.
bool isSoft(const study::StudyRecord& record, const study::ReferencePictures& row) {
  return std::any_of(
      record.results.begin(), record.results.end(), [&](const study::ResultRecord& result) {
        return result.view == row.view && result.light == row.light && !result.shares.empty();
      });
}

/// Copies what was kept and draws the change.
void drawChange(study::ReferencePictures& row, RunFolder& folder, const fs::path& old) {
  Mask before = maskOfDifference(old);
  Mask after = maskOfDifference(folder.path() / row.after);
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
  folder.write(row.change, image::pngOf(image::differenceImage(after, before)));
}

}  // namespace

Mask maskOfDifference(const fs::path& path) {
  const image::GreyPicture picture = image::readGreyPicture(path, "R");
  Mask mask{picture.width, picture.height, {}};
  mask.samples.reserve(picture.values.size());
  for (const float red : picture.values) mask.samples.push_back(shadeOf(red, path));
  return mask;
}

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
    if (isSoft(record, row)) {
      row.note = "the pictures of a soft light hold shares, which are not told apart here";
      rows.push_back(std::move(row));
      continue;
    }
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

#include "report/view_images.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/parallel.h"
#include "image/images.h"
#include "image/mask_picture.h"

namespace gnomon::report {

namespace {

// As shade.frag shades the base mesh.
constexpr std::array albedo = {0.86F, 0.80F, 0.72F};
constexpr float ambient = 0.16F;
constexpr float gamma = 2.2F;

std::uint8_t shadedByte(float reflectance, float light) {
  const float linear = reflectance * (ambient + (1 - ambient) * light);
  return static_cast<std::uint8_t>(std::lround(255 * std::pow(linear, 1 / gamma)));
}

image::Rgb shaded(float light) {
  return {shadedByte(albedo[0], light), shadedByte(albedo[1], light), shadedByte(albedo[2], light)};
}

}  // namespace

image::Image displacedImage(int width, int height, const std::vector<float>& light) {
  image::Image image{width, height, std::vector<std::uint8_t>(albedo.size() * light.size(), 255)};
  const image::Rgb shadowed = shaded(0);
  parallelFor(
      0, light.size(),
      [&](std::size_t i) {
        if (light[i] < 0) return;
        const image::Rgb colour = light[i] == 0 ? shadowed : shaded(light[i]);
        std::copy(colour.begin(), colour.end(), &image.rgb[colour.size() * i]);
      },
      4096);
  return image;
}

image::Rgb regionColour(truth::Region region) {
  switch (region) {
    case truth::Region::none:
      return {image::MaskGreys::none, image::MaskGreys::none, image::MaskGreys::none};
    case truth::Region::lit:
      return {255, 255, 255};
    case truth::Region::attached:
      return {0, 63, 92};
    case truth::Region::cast:
      return {26, 133, 255};
    case truth::Region::distant:
      return {230, 97, 0};
    case truth::Region::global:
      return {212, 17, 89};
    case truth::Region::beyondTerminator:
      return {0, 0, 0};
  }
  throw InternalError("a region without a colour");
}

image::PaletteImage regionImage(const truth::Truth& truth) {
  const auto number = [](truth::Region region) { return static_cast<std::uint8_t>(region); };
  std::vector<image::Rgb> colours(truth::reportedRegions.size() + 1);
  colours.at(number(truth::Region::none)) = regionColour(truth::Region::none);
  for (const truth::Region region : truth::reportedRegions) {
    colours.at(number(region)) = regionColour(region);
  }
  image::PaletteImage image{truth.mask.width, truth.mask.height, std::move(colours),
                            std::vector<std::uint8_t>(truth.regions.size())};
  std::transform(truth.regions.begin(), truth.regions.end(), image.values.begin(), number);
  return image;
}

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

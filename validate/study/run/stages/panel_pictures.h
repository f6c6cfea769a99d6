#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/mask.h"
#include "study/record/record.h"
#include "study/run/scene/base_case.h"
#include "study/run/scene/method_case.h"
#include "study/run/scene/run_scene.h"
#include "study/run/scene/truth_stage.h"
#include "study/run/stages/run_writer.h"
#include "study/run/stages/truth_pictures.h"
#include "truth/shadow_tracer.h"

namespace gnomon::study {

/// Pixels of 8 bits: red, green and blue, row by row, row 0 at the top.
using RgbPixels = std::vector<std::uint8_t>;

/// An answer as its pictures show it: a mask, and under a light with a disc the shares in its
/// place.
struct ShownAnswer {
  const Mask& mask;
  const Visibility& shares;

  [[nodiscard]] bool isSoft() const { return shares.size() > 0; }
};
ShownAnswer shownOf(const truth::Truth& truth);

/// A mesh as shade.frag draws it: with all its samples lit, and with all of them shadowed.
struct MeshColours {
  RgbPixels lit;
  std::shared_ptr<const RgbPixels> dark;
};

/// An answer's shading: `dark` where the sample is shadowed, else `lit`; by a share V of light the
/// colour in linear light, (dark^2.2 + V (lit^2.2 - dark^2.2))^(1 / 2.2).
RgbPixels shadingOf(const MeshColours& colours, const ShownAnswer& shown);
/// The same of one sample.
std::array<std::uint8_t, 3> shadingAt(const MeshColours& colours, const ShownAnswer& shown,
                                      std::size_t sample);

/// The grey of a sample in the picture of an answer's mask: white is lit.
std::array<std::uint8_t, 3> maskGrey(const ShownAnswer& shown, std::size_t sample);

/// The bytes of an answer's mask, or of its map of visibility.
std::string maskFile(const RunWriter& writer, const ShownAnswer& shown);
/// The bytes of its signed difference from the truth.
std::string differenceFile(const RunWriter& writer, const ShownAnswer& shown,
                           const ShownAnswer& truth);

/// One method's answers, to be shown in a panel.
struct PanelAnswer {
  std::size_t place;  ///< of the method in the study
  MethodCase* method;
  /// Both, drawn when they are first asked for.
  std::function<const CaseAnswers&()> answers;
};

/// Makes the pictures of a study's panels, or takes them from the cache, and hands them to the
/// writer. A mesh is drawn twice for each view and light, with all its samples lit and with all of
/// them shadowed: its shadings are composed of the two. Files are named
/// `images/VIEW_LIGHT_METHOD.png`, the method being `truth` or `displaced` for those, and masks
/// likewise in `masks/`: the drawn answers; in `masks/test/` those of the shadow tests alone. Under
/// a light with a disc masks are maps of visibility, shadings lie between the two by their shares,
/// and a page embeds each shading whole. See also DisplacedPictures and TruthPictures.
class PanelPictures {
 public:
  PanelPictures(RunScene& scene, RunWriter& writer);

  /// The displaced surface by its own rays, for every camera view and light.
  void drawDisplaced(SurfaceOnDemand& surface);

  /// One view under one light: the shading and mask of every method that answers, those of the
  /// truth, and the signed differences.
  PanelRecord draw(std::size_t view, std::size_t light, std::span<const PanelAnswer> answers);

 private:
  struct Answer;
  struct Mesh;
  struct Picture;
  /// An answer's shading and mask, and but for the truth its difference and its test's mask: first
  /// what a page embeds.
  [[nodiscard]] std::vector<Picture> picturesOf(std::size_t view, std::size_t light,
                                                const std::string& name,
                                                const Answer& answer) const;
  /// For each of some answers, which are drawn, the first of them that has the same pictures.
  /// @param places  of those among all
  static std::vector<std::size_t> firstToLookSo(const std::vector<Answer>& answers,
                                                const std::vector<std::size_t>& places);
  // What these put into the queue refers to their arguments and results: all stay until the queue
  // is finished.

  /// @return each answer's pictures, which `write` writes once the queue is finished
  std::vector<std::vector<Picture>> queueAnswers(std::size_t view, std::size_t light,
                                                 const std::vector<Answer>& answers);
  void write(std::vector<Picture>& pictures);
  /// Where an answer errs most. In pictures of masks where the truth's picture shows other samples.
  /// @param right  the truth, as it is shown
  [[nodiscard]] std::vector<WorstPlace> placesOf(const Answer& answer, const Answer& right) const;
  /// The same of all answers but the last, which is the truth.
  void queuePlaces(const std::vector<Answer>& shown, std::vector<std::vector<WorstPlace>>& places);
  void queueLayers(std::size_t view, std::size_t light, const BaseCase& base, Mesh& mesh);
  /// Draws one view of a mesh under one light.
  RgbPixels shade(std::size_t view, std::size_t light, const BaseCase& base, Shade everywhere);
  /// The same with all samples shadowed, which is kept: what shade.frag leaves there is ambient
  /// light, the same under all lights.
  /// @param light  any
  std::shared_ptr<const RgbPixels> dark(std::size_t view, std::size_t light, const BaseCase& base);

  RunScene& scene_;
  RunWriter& writer_;
  PictureOutput output_;
  DisplacedPictures displaced_{output_};
  TruthPictures truths_{output_};
};

}  // namespace gnomon::study

#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/passes/passes.h"
#include "study/record/record.h"
#include "study/run/scene/base_case.h"
#include "study/run/scene/method_case.h"
#include "study/run/scene/run_scene.h"
#include "study/run/scene/truth_stage.h"
#include "study/run/stages/encoding_queue.h"
#include "study/run/stages/run_writer.h"
#include "study/spec/file_names.h"

namespace gnomon::study {

/// One method's answers, to be shown in a panel.
struct PanelAnswer {
  std::size_t place;  ///< of the method in the study
  MethodCase* method;
  /// Both, drawn when they are first asked for.
  std::function<const CaseAnswers&()> answers;
};

/// An answer as its pictures show it: a mask, and under a light with a disc the shares in its
/// place.
struct ShownAnswer {
  const Mask& mask;
  const Visibility& shares;

  [[nodiscard]] bool isSoft() const { return shares.size() > 0; }
};

/// Makes the pictures of a study's panels, or takes them from the cache, and hands them to the
/// writer. A mesh is drawn twice for each view and light, with all its samples lit and with all of
/// them shadowed: its shadings are composed of the two. Files are named
/// `images/VIEW_LIGHT_METHOD.png`, the method being `truth` or `displaced` for those, and masks
/// likewise in `masks/`: the drawn answers; in `masks/test/` those of the shadow tests alone. Under
/// a light with a disc masks are maps of visibility, shadings lie between the two by their shares,
/// and a page embeds each shading whole. The truth's regions are `regions/VIEW_LIGHT_truth.png`;
/// for a method whose mesh has other samples than the standard base, it is `truth_displaced-9`,
/// after the mesh's pieces a side. The weights of an atlas's samples are
/// `regions/VIEW_weights.exr`.
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
  /// 8 bits, row 0 at the top.
  using Rgb = std::vector<std::uint8_t>;

  /// `images/VIEW_LIGHT_NAME.png`, or in another folder.
  [[nodiscard]] std::string path(const char* folder, std::size_t view, std::size_t light,
                                 const std::string& name) const;
  /// An answer's shading and mask, and but for the truth its difference and its test's mask: first
  /// what a page embeds.
  [[nodiscard]] std::vector<Picture> picturesOf(std::size_t view, std::size_t light,
                                                const std::string& name,
                                                const Answer& answer) const;
  /// For each of some answers, which are drawn, the first of them that has the same pictures.
  /// @param places  of those among all
  static std::vector<std::size_t> firstToLookSo(const std::vector<Answer>& answers,
                                                const std::vector<std::size_t>& places);
  // What `queue…` hands to the queue refers to its arguments and results, and fills these.

  /// @return each answer's pictures, which `write` writes once the queue is finished
  std::vector<std::vector<Picture>> queueAnswers(std::size_t view, std::size_t light,
                                                 const std::vector<Answer>& answers);
  void write(std::vector<Picture>& pictures);
  /// Where an answer errs most. In pictures of masks where the truth's picture shows other samples.
  /// @param right  the truth, as it is shown
  [[nodiscard]] std::vector<WorstPlace> placesOf(const Answer& answer, const Answer& right) const;
  /// The same of all answers but the last, which is the truth.
  void queuePlaces(const std::vector<Answer>& shown, std::vector<std::vector<WorstPlace>>& places);
  /// The truth at a mesh's samples. The mask of the standard base's truth is not among it: that is
  /// written with its shading.
  TruthFilesRecord queueTruth(std::size_t view, std::size_t light, const BaseCase& base);
  void queueLayers(std::size_t view, std::size_t light, const BaseCase& base, Mesh& mesh);
  /// Writes the weights of an atlas's samples, once: they are the same under all lights and on all
  /// meshes.
  /// @return the file; empty for a camera
  std::string writeWeights(std::size_t view);
  /// The displaced surface in a camera view by its own rays: diffuse light per pixel.
  std::vector<float> lightDisplaced(std::size_t view, std::size_t light, const Camera& camera,
                                    const TracedSurface& traced);
  /// Draws one view of a mesh under one light.
  Rgb shade(std::size_t view, std::size_t light, const BaseCase& base, Shade everywhere);
  /// The same with all samples shadowed: no light changes that (shade.frag), so that it is kept.
  /// @param light  any
  std::shared_ptr<const Rgb> dark(std::size_t view, std::size_t light, const BaseCase& base);

  RunScene& scene_;
  RunWriter& writer_;
  EncodingQueue queue_;
  std::set<std::size_t> viewsWithWeights_;  ///< whose file is written
  CaseNames names_;
  /// As a page embeds the displaced surface, by view and light.
  std::map<std::pair<std::size_t, std::size_t>, std::string> displaced_;
};

}  // namespace gnomon::study

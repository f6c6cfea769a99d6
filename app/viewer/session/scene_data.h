#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "cache/content_key.h"
#include "common/progress.h"
#include "displaced/displaced_mesh.h"
#include "horizon/angle_table.h"
#include "horizon/horizon_bake.h"
#include "horizon/stored_table.h"
#include "model/cross_section.h"
#include "render/method.h"
#include "study/run/method_trial.h"
#include "study/run/scene/base_case.h"
#include "study/spec/study_file.h"
#include "surface/base_mesh.h"
#include "surface/limit_surface.h"
#include "surface/texture_layout.h"

namespace gnomon::app {

/// What the window shows of a study, as values in main memory: made on a background thread, shared
/// as const, copied to the GPU by the thread that draws. Parts that a change does not touch are the
/// same objects as before.

/// What a scene is made from.
struct SceneRequest {
  study::StudyOptions options;     ///< with the overrides that the sliders make
  std::vector<std::string> shown;  ///< labels of the methods that need meshes and tables
  bool directions = false;         ///< the lines of the principal directions are wanted
  int shaders = 0;                 ///< counts the changes of shader files
  bool soft = false;               ///< the light has a disc
};

/// A table as a texture holds it.
struct TableImage {
  horizon::StoredTable values;
  horizon::TableShape shape;
};

struct TableImagePair {
  TableImage horizon;
  TableImage distance;
};

/// A mesh that methods draw.
struct MeshData {
  surface::BaseMesh base;  ///< of a displaced mesh: empty, see `displaced`
  std::optional<displaced::DisplacedMesh> displaced;
  std::shared_ptr<const surface::TextureLayout> layout = {};  ///< of its surface
  [[nodiscard]] const surface::BaseMesh& mesh() const { return displaced ? displaced->mesh : base; }
};

/// One method with what it reads; tables that it does not declare are null.
struct MethodData {
  study::MethodSpec spec;
  render::Method method;
  study::MeshChoice mesh;
  std::optional<study::MeshChoice> lightMesh;  ///< drawn from the light alone
  std::shared_ptr<const TableImagePair> tables;
  std::shared_ptr<const horizon::AngleTable> angles;  ///< of the flat relief
  std::shared_ptr<const TableImage> ellipses;
};

/// What a part is made from, by contents, whichever files they come from: equal keys, equal parts.
struct SceneKeys {
  cache::ContentKey surface;  ///< the cage
  cache::ContentKey relief;   ///< the height map as it lies on the surface
  cache::ContentKey truth;    ///< both, and how finely the displaced surface is cut
};

SceneKeys sceneKeys(const study::StudySpec& study);

struct SceneData {
  SceneKeys keys;
  int shaders = 0;    ///< of its request: methods compile again where it is another
  bool soft = false;  ///< of its request: methods may answer with shares

  std::shared_ptr<const study::StudySpec> study;
  std::shared_ptr<const surface::LimitSurface> surface;
  std::shared_ptr<const surface::TextureLayout> layout;
  std::shared_ptr<const relief::HeightField> heights;
  double texelsPerHeight = 1;  ///< of the frame of angles (angle_table.h)
  std::map<study::MeshChoice, std::shared_ptr<const MeshData>> meshes;
  std::shared_ptr<const PrincipalLines> lines;                       ///< null unless asked for
  std::map<std::string, std::shared_ptr<const MethodData>> methods;  ///< those shown, by label

  /// The mesh that stands for the study itself.
  [[nodiscard]] study::MeshChoice standardMesh() const {
    return {render::DrawnMesh::base, study->base};
  }
};

/// Makes scenes and keeps what the next one can use again: tables by what they were baked with.
class SceneMaker {
 public:
  /// @param trial  of a method, before the driver gets it, each time that its file is another
  SceneMaker(std::filesystem::path study, study::MethodTrial trial)
      : file_(std::move(study)), trial_(std::move(trial)) {}

  /// @param progress  of a stage by name; may throw to cancel
  /// @throws InputError as readStudy, readMethod and the bakers
  std::shared_ptr<const SceneData> make(
      const SceneRequest& request, const std::function<Progress(const std::string&)>& progress);

 private:
  using TableKey = std::tuple<int, double, horizon::TableBits>;  ///< azimuths, radius
  /// Azimuths, radius, and bits or limit, in a frame of so many texels a height unit.
  using EllipseKey = std::pair<TableKey, double>;
  using AngleKey = std::tuple<int, double, double, double>;
  struct Tables {
    std::map<std::pair<int, double>, std::shared_ptr<const horizon::HorizonTables>> bakes;
    std::map<TableKey, std::shared_ptr<const TableImagePair>> pairs;
    std::map<EllipseKey, std::shared_ptr<const TableImage>> ellipses;
    std::map<AngleKey, std::shared_ptr<const horizon::AngleTable>> angles;
  };
  using StageProgress = std::function<Progress(const std::string&)>;

  std::shared_ptr<const horizon::HorizonTables> bake(const relief::HeightField& field,
                                                     const horizon::BakeSettings& settings,
                                                     const StageProgress& progress);
  std::shared_ptr<const TableImagePair> pair(const relief::HeightField& field,
                                             const study::BakeSpec& spec,
                                             const StageProgress& progress);
  std::shared_ptr<const TableImage> ellipses(const SceneData& scene, const study::BakeSpec& spec,
                                             const StageProgress& progress);
  std::shared_ptr<const horizon::AngleTable> angles(const SceneData& scene,
                                                    const study::BakeSpec& spec,
                                                    const StageProgress& progress);
  static void addMesh(SceneData& scene, study::MeshChoice choice, const SceneData* previous);
  std::shared_ptr<const MethodData> method(const SceneData& scene, const study::MethodSpec& spec,
                                           const StageProgress& progress);
  void requireTried(const study::MethodSpec& spec, const render::Method& method, relief::Wrap wrap);
  void forgetUnused(const SceneData& scene);

  std::filesystem::path file_;
  study::MethodTrial trial_;
  std::map<cache::ContentKey, std::string>
      trials_;  ///< by what the method's file held: why it may not
  std::shared_ptr<const SceneData> last_;
  cache::ContentKey tablesOf_;  ///< of the relief that the tables were baked from
  Tables tables_;
};

}  // namespace gnomon::app

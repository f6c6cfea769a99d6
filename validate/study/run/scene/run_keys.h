#pragma once

#include <compare>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "cache/content_key.h"
#include "render/gl_context.h"
#include "render/method.h"
#include "study/spec/sections/bake_section.h"
#include "study/spec/study_file.h"

namespace gnomon::study {

/// Which mesh: the base mesh or the displaced one, of so many pieces of every face's side.
struct MeshChoice {
  render::DrawnMesh kind = render::DrawnMesh::base;
  BaseSpec base = {};

  // NOLINTNEXTLINE(modernize-use-nullptr): it takes the comparison's own 0 for a pointer
  friend auto operator<=>(const MeshChoice&, const MeshChoice&) = default;
};

/// Everything of this program that a result may depend on apart from its inputs: the bytes of the
/// program or library that computes it (so any change of its sources), and the versions of
/// OpenSubdiv and Embree. A cache adds it to every key. Shaders are files, and enter where they are
/// used; so does the GL renderer.
cache::ContentKey programKey();

/// The processor, by its name and by what it can do. A cache adds it to every key but those of
/// results that hold on any (HoldsOn).
cache::ContentKey processorKey();

/// Every file that methods and passes are made of apart from a method's own.
/// @param shaders  the folder that holds `common/`
cache::ContentKey shadersKey(const std::filesystem::path& shaders);

/// The files that a method brings: its own, what it includes, and its textures.
cache::ContentKey methodFilesKey(const render::Method& method);

/// The surface of a study: its keys, and the control mesh that they give.
cache::ContentKey surfaceKey(const StudySpec& study);

/// The height map of a study as it lies on the surface: its keys, and the texels that they give.
cache::ContentKey reliefKey(const StudySpec& study);

/// The keys of a `[bake]` that enter a result.
cache::ContentKey settingsKey(const BakeSpec& bake, Enters result);

/// The horizon tables of a height field.
cache::ContentKey bakeKey(const relief::HeightField& field, const BakeSpec& bake);

/// The cache keys of everything that a run of one study computes. A key is made from what its
/// result depends on, and nothing else: titles, names, thresholds and the study's other methods
/// enter no key. Where a result depends on another result, the key of that one enters. Settings
/// enter by the declarations of their sections (study_key.h), so that none can be forgotten.
class RunKeys {
 public:
  /// @param study     outlives the keys
  /// @param gl        its renderer and version enter
  /// @param shaders   the folder: every file of `common/` enters
  RunKeys(const StudySpec& study, const render::GlContext& gl,
          const std::filesystem::path& shaders);

  /// A mesh as it is drawn.
  [[nodiscard]] cache::ContentKey mesh(const MeshChoice& choice) const;
  /// A view's samples on a mesh, with their layout and weights.
  [[nodiscard]] cache::ContentKey samples(const MeshChoice& mesh, std::size_t view) const;
  /// The displaced micro-mesh that the truth is traced on; where its step is searched, all that the
  /// search looks at.
  [[nodiscard]] cache::ContentKey surface() const;
  /// The truth of a view on a mesh under one light, traced on the study's micro-mesh.
  [[nodiscard]] cache::ContentKey truth(const MeshChoice& mesh, std::size_t view,
                                        std::size_t light) const;
  /// The bins of a view's samples on every axis, under one light.
  [[nodiscard]] cache::ContentKey bins(const MeshChoice& mesh, std::size_t view,
                                       std::size_t light) const;
  /// What a view shows of a mesh under one light where all of it is lit, and all shadowed.
  [[nodiscard]] cache::ContentKey layers(const MeshChoice& mesh, std::size_t view,
                                         std::size_t light) const;
  /// The same where all of it is shadowed, which is the same under all lights.
  [[nodiscard]] cache::ContentKey dark(const MeshChoice& mesh, std::size_t view) const;
  /// The displaced surface by its own rays, in a camera view.
  [[nodiscard]] cache::ContentKey displacedPicture(std::size_t view, std::size_t light) const;
  /// What a camera sees of that surface, whatever the light.
  [[nodiscard]] cache::ContentKey seenSurface(std::size_t view) const;
  /// Ellipses fitted to the horizons of a bake.
  [[nodiscard]] cache::ContentKey ellipses(const BakeSpec& bake, double texelsPerHeight) const;
  /// Horizon angles shot on the study's micro-mesh, at the texels that a mesh shows.
  [[nodiscard]] cache::ContentKey surfaceAngles(const MeshChoice& mesh, const BakeSpec& bake) const;
  /// The tables that a method bakes by its own functions.
  /// @param parameters  those that the functions may use, with their values
  [[nodiscard]] cache::ContentKey methodBakes(const MethodSpec& spec, const render::Method& method,
                                              const std::map<std::string, double>& parameters,
                                              double texelsPerHeight) const;
  /// A method with all that its answers depend on: shaders, parameters, filter, tables and mesh.
  [[nodiscard]] cache::ContentKey method(const MethodSpec& spec,
                                         const render::Method& method) const;
  /// Its shaders compiled, whatever the study.
  [[nodiscard]] cache::ContentKey program(const MethodSpec& spec,
                                          const render::Method& method) const;
  /// The shaders of pictures compiled.
  [[nodiscard]] cache::ContentKey shading(render::DrawnMesh mesh) const;
  /// What its shader answers at every sample of a view under one light.
  [[nodiscard]] cache::ContentKey mask(const cache::ContentKey& method, const MeshChoice& mesh,
                                       std::size_t view, std::size_t light) const;

 private:
  [[nodiscard]] cache::ContentKey light(std::size_t index) const;

  const StudySpec& study_;
  cache::ContentKey shaders_;
  cache::ContentKey driver_;
  cache::ContentKey place_;  ///< renderer, limit surface and relief
};

/// The mesh that a method draws in a study.
MeshChoice meshOf(const MethodSpec& spec, const render::Method& method);

/// The mesh that it draws from the light alone, if it has one of its own for that.
/// @throws InputError for a number of pieces that is not whole or outside its range
std::optional<MeshChoice> lightMeshOf(const MethodSpec& spec, const render::Method& method);

}  // namespace gnomon::study

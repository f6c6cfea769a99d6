#include "study/run/stages/panel_pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "common/lists.h"
#include "common/on_demand.h"
#include "common/parallel.h"
#include "study/run/scene/cached_fields.h"
#include "study/run/stages/worst_places.h"
#include "truth/displaced_picture.h"

namespace gnomon::study {
namespace {

/// A picture as a file and as a page embeds it.
struct PictureBytes {
  std::string file;
  std::string embedded;
};

template <typename Stream, cache::SameAs<PictureBytes> T>
void fields(Stream& stream, T& bytes) {
  stream(bytes.file, bytes.embedded);
}

/// What tells the truth at the samples of a mesh, as files.
struct TruthBytes {
  std::string mask, regions, seam;
};

template <typename Stream, cache::SameAs<TruthBytes> T>
void fields(Stream& stream, T& bytes) {
  stream(bytes.mask, bytes.regions, bytes.seam);
}

bool isSame(const ShownAnswer& a, const ShownAnswer& b) {
  return a.mask.samples == b.mask.samples && gnomon::isSame(a.shares, b.shares);
}

ShownAnswer shownOf(const truth::Truth& truth) {
  return {truth.mask, truth.visibility};
}

std::string maskFile(const RunWriter& writer, const ShownAnswer& shown) {
  return shown.isSoft() ? writer.shares(shown.shares) : writer.mask(shown.mask);
}

std::string differenceFile(const RunWriter& writer, const ShownAnswer& shown,
                           const ShownAnswer& truth) {
  return shown.isSoft() ? writer.difference(shown.shares, truth.shares)
                        : writer.difference(shown.mask, truth.mask);
}

/// The colour between two of shade.frag's by a share of light, which is linear before its encoding.
std::uint8_t between(std::uint8_t dark, std::uint8_t lit, double share) {
  constexpr double encoding = 2.2;
  const auto light = [](std::uint8_t value) { return std::pow(value / 255.0, encoding); };
  const double mixed = light(dark) + share * (light(lit) - light(dark));
  return static_cast<std::uint8_t>(std::lround(255 * std::pow(mixed, 1 / encoding)));
}

/// The grey of an answer's mask: white is lit.
std::array<std::uint8_t, 3> maskGrey(const ShownAnswer& shown, std::size_t i) {
  constexpr std::uint8_t none = 128;
  if (shown.mask.samples[i] == Shade::none) return {none, none, none};
  const float hard = shown.mask.samples[i] == Shade::lit ? 1.0F : 0.0F;
  const float share = shown.isSoft() ? shown.shares.shares[i] : hard;
  const auto grey = static_cast<std::uint8_t>(std::lround(255 * share));
  return {grey, grey, grey};
}

/// Where a sample's path to the light crosses a seam: lit.
Mask seamMask(const truth::Truth& truth) {
  Mask mask = truth.mask;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask.samples[i] == Shade::none) continue;
    mask.samples[i] = truth.crossesSeam[i] != 0 ? Shade::lit : Shade::shadowed;
  }
  return mask;
}

/// How file names call the truth at a mesh's samples.
std::string truthName(const BaseCase& base, const BaseCase& standard, std::size_t view,
                      std::size_t light) {
  if (&base == &standard) return "truth";
  const truth::Truth& own = base.views[view].truths[light];
  const truth::Truth& other = standard.views[view].truths[light];
  const bool isSame = own.mask.samples == other.mask.samples && own.regions == other.regions &&
                      own.crossesSeam == other.crossesSeam &&
                      gnomon::isSame(own.visibility, other.visibility);
  if (isSame) return "truth";
  const char* kind = base.choice.kind == render::DrawnMesh::displaced ? "displaced" : "base";
  return fmt::format("truth_{}-{}", kind, base.choice.base.subdivisions);
}

}  // namespace

/// An answer of a panel with the keys of its pictures. Its mask is asked for only where one of them
/// has to be made.
struct PanelPictures::Answer {
  std::string name;  ///< of its files
  cache::ContentKey key;
  const Mesh& mesh;
  const truth::Truth* truth;  ///< what it is held against; null for the truth itself
  bool sharesPicture;         ///< whether the truth's picture shows its samples
  std::function<ShownAnswer()> drawn;
  std::function<ShownAnswer()> test = {};  ///< of the shadow test alone; none for the truth

  /// Whether all pictures of two answers are the same. Both are drawn.
  [[nodiscard]] bool looksLike(const Answer& other) const {
    return truth != nullptr && truth == other.truth && &mesh == &other.mesh &&
           isSame(drawn(), other.drawn()) && isSame(test(), other.test());
  }
};

/// A mesh in a panel. It is drawn only where a picture of it has to be made.
struct PanelPictures::Mesh {
  /// With all its samples lit, and with all of them shadowed.
  struct Colours {
    Rgb lit;
    std::shared_ptr<const Rgb> dark;
  };

  OnDemand<Colours> colours;
  LayersRecord layers = {};  ///< both as a page embeds them, once the queue is finished

  /// An answer's shading: the dark colours where it is shadowed, and between both by its shares.
  [[nodiscard]] Rgb shading(const ShownAnswer& shown) const {
    const Colours& both = colours.get();
    Rgb rgb = both.lit;
    const std::vector<Shade>& samples = shown.mask.samples;
    if (shown.isSoft()) {
      for (std::size_t i = 0; i < samples.size(); ++i)
        shadeSample(shown, i, *both.dark, &rgb[3 * i]);
      return rgb;
    }
    // Shadowed samples lie together.
    for (auto first = samples.begin(); first != samples.end();) {
      first = std::find(first, samples.end(), Shade::shadowed);
      const auto end =
          std::find_if(first, samples.end(), [](Shade shade) { return shade != Shade::shadowed; });
      const auto byte = 3 * (first - samples.begin());
      std::copy_n(both.dark->begin() + byte, 3 * (end - first), rgb.begin() + byte);
      first = end;
    }
    return rgb;
  }

  /// The same of one sample.
  [[nodiscard]] std::array<std::uint8_t, 3> shadingAt(const ShownAnswer& shown,
                                                      std::size_t i) const {
    const Colours& both = colours.get();
    std::array<std::uint8_t, 3> rgb{};
    std::copy_n(&both.lit[3 * i], 3, rgb.data());
    shadeSample(shown, i, *both.dark, rgb.data());
    return rgb;
  }

 private:
  /// @param rgb  of the sample lit
  static void shadeSample(const ShownAnswer& shown, std::size_t i, const Rgb& darkColours,
                          std::uint8_t* rgb) {
    const std::uint8_t* dark = &darkColours[3 * i];
    const double share = shown.isSoft() ? static_cast<double>(shown.shares.shares[i]) : 0;
    if (share > 0) {
      for (std::size_t k = 0; share < 1 && k < 3; ++k) rgb[k] = between(dark[k], rgb[k], share);
    } else if (shown.mask.samples[i] == Shade::shadowed) {
      std::copy_n(dark, 3, rgb);
    }
  }
};

PanelPictures::PanelPictures(RunScene& scene, RunWriter& writer)
    : scene_(scene), writer_(writer), queue_(scene.clock), names_(caseNames(scene.study)) {}

std::string PanelPictures::path(const char* folder, std::size_t view, std::size_t light,
                                const std::string& name) const {
  return fmt::format("{}/{}_{}_{}.png", folder, names_.views[view], names_.lights[light], name);
}

void PanelPictures::drawDisplaced(SurfaceOnDemand& surface) {
  for (std::size_t v = 0; v < scene_.study.views.size(); ++v) {
    const Camera* camera = cameraOf(scene_.study.views[v]);
    if (camera == nullptr) continue;
    for (std::size_t l = 0; l < scene_.study.lights.size(); ++l) {
      const cache::ContentKey key = scene_.keys.displacedPicture(v, l);
      const auto use = [this, v, l](PictureBytes bytes) {
        writer_.write(path("images", v, l, "displaced"), bytes.file);
        displaced_[{v, l}] = std::move(bytes.embedded);
      };
      if (auto found = scene_.cache.find<PictureBytes>(key)) {
        queue_.add({}, [use, bytes = std::move(*found)] { use(bytes); });
        continue;
      }
      const auto light = lightDisplaced(v, l, *camera, surface.get());
      const auto rgb = scene_.clock.measure("writing", [&](const Progress&) {
        return std::make_shared<const Rgb>(writer_.displaced(camera->width, camera->height, light));
      });
      const auto made = std::make_shared<PictureBytes>();
      queue_.add(
          {[this, camera, rgb, made] {
             made->embedded =
                 writer_.embedded(camera->width, camera->height, *rgb, EmbeddedSize::full);
           },
           [this, camera, rgb, made] {
             made->file = writer_.picture(camera->width, camera->height, *rgb);
           }},
          [this, key, made, use] {
            scene_.cache.keep(key, *made);
            use(std::move(*made));
          },
          rgb->size());
    }
  }
}

std::vector<float> PanelPictures::lightDisplaced(std::size_t view, std::size_t light,
                                                 const Camera& camera,
                                                 const TracedSurface& traced) {
  return scene_.clock.measure("displaced picture", [&](const Progress& progress) {
    const auto bytes = [](const truth::SeenSurface& seen) {
      return sizeof(truth::SeenSurface::Point) * seen.points.size();
    };
    const auto seen = scene_.store.get<truth::SeenSurface>(
        scene_.keys.seenSurface(view),
        [&] {
          return std::make_shared<const truth::SeenSurface>(
              truth::seenSurface(traced.mesh, traced.scene, camera, progress));
        },
        bytes);
    return truth::displacedPicture(*seen, traced.scene, scene_.study.lights[light].direction(),
                                   progress);
  });
}

PanelPictures::Rgb PanelPictures::shade(std::size_t view, std::size_t light, const BaseCase& base,
                                        Shade everywhere) {
  return scene_.clock.measure("pictures", [&](const Progress&) {
    const render::DrawnMesh kind = base.choice.kind;
    const auto pass = scene_.store.get<render::ShadePass>(
        scene_.keys.shading(kind),
        [&] {
          return std::make_shared<const render::ShadePass>(scene_.shaders,
                                                           scene_.study.relief.field.wrap(), kind);
        },
        [](const render::ShadePass&) { return programBytes; });
    const render::RenderView& seen = base.views[view].view;
    const auto pixels =
        static_cast<std::size_t>(seen.width) * static_cast<std::size_t>(seen.height);
    return pass->render(seen, scene_.drawing(base, light),
                        {seen.width, seen.height, std::vector<Shade>(pixels, everywhere)});
  });
}

std::shared_ptr<const PanelPictures::Rgb> PanelPictures::dark(std::size_t view, std::size_t light,
                                                              const BaseCase& base) {
  return scene_.store.get<Rgb>(
      scene_.keys.dark(base.choice, view),
      [&] { return std::make_shared<const Rgb>(shade(view, light, base, Shade::shadowed)); },
      [](const Rgb& rgb) { return rgb.size(); });
}

void PanelPictures::queueLayers(std::size_t view, std::size_t light, const BaseCase& base,
                                Mesh& mesh) {
  const cache::ContentKey key = scene_.keys.layers(base.choice, view, light);
  if (auto found = scene_.cache.find<LayersRecord>(key)) {
    mesh.layers = std::move(*found);
    return;
  }
  const Mesh::Colours& colours = mesh.colours.get();
  const render::RenderView& seen = base.views[view].view;
  const auto embed = [this, &seen](const Rgb& rgb) {
    return writer_.embedded(seen.width, seen.height, rgb, EmbeddedSize::full);
  };
  std::vector<EncodingQueue::Work> encodings = {
      [embed, &mesh, &colours] { mesh.layers.lit = embed(colours.lit); }};
  const cache::ContentKey darkKey = scene_.keys.dark(base.choice, view);
  const auto held = scene_.store.held<std::string>(darkKey);
  if (held) {
    mesh.layers.dark = *held;
  } else {
    encodings.emplace_back([embed, &mesh, &colours] { mesh.layers.dark = embed(*colours.dark); });
  }
  queue_.add(std::move(encodings), [this, key, darkKey, &mesh] {
    scene_.cache.keep(key, mesh.layers);
    scene_.store.get<std::string>(
        darkKey, [&] { return std::make_shared<const std::string>(mesh.layers.dark); },
        [](const std::string& bytes) { return bytes.size(); });
  });
}

/// One picture of an answer.
struct PanelPictures::Picture {
  const char* kind;
  std::string path;  ///< empty: none of a file
  std::function<std::string()> make;
  cache::ContentKey key = {};
  std::optional<std::string> bytes = {};
  const Picture* same = nullptr;  ///< one of another answer that has its bytes
};

std::vector<PanelPictures::Picture> PanelPictures::picturesOf(std::size_t view, std::size_t light,
                                                              const std::string& name,
                                                              const Answer& answer) const {
  const auto shaded = [&answer] { return answer.mesh.shading(answer.drawn()); };
  const EmbeddedSize size =
      scene_.study.lights[light].isSoft() ? EmbeddedSize::full : EmbeddedSize::small;
  // The longest first.
  std::vector<Picture> pictures = {{"embedded", "",
                                    [&answer, this, shaded, size] {
                                      const Mask& mask = answer.drawn().mask;
                                      return writer_.embedded(mask.width, mask.height, shaded(),
                                                              size);
                                    }},
                                   {"shaded", path("images", view, light, name),
                                    [&answer, this, shaded] {
                                      const Mask& mask = answer.drawn().mask;
                                      return writer_.picture(mask.width, mask.height, shaded());
                                    }},
                                   {"mask", path("masks", view, light, name),
                                    [&answer, this] { return maskFile(writer_, answer.drawn()); }}};
  if (answer.truth != nullptr) {
    pictures.push_back(
        {"difference", path("images", view, light, name + "_difference"), [&answer, this] {
           return differenceFile(writer_, answer.drawn(), shownOf(*answer.truth));
         }});
    pictures.push_back({"test mask", path("masks/test", view, light, name),
                        [&answer, this] { return maskFile(writer_, answer.test()); }});
  }
  return pictures;
}

std::vector<std::vector<PanelPictures::Picture>> PanelPictures::queueAnswers(
    std::size_t view, std::size_t light, const std::vector<Answer>& answers) {
  std::vector<std::vector<Picture>> pictures;
  std::vector<std::size_t> drawn;  // answers of which some are not there
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const Answer& answer = answers[i];
    bool isAnyMissing = false;
    for (Picture& picture : pictures.emplace_back(picturesOf(view, light, answer.name, answer))) {
      picture.key = cache::KeyBuilder(picture.kind).add("answer", answer.key).key();
      picture.bytes = scene_.cache.find<std::string>(picture.key);
      isAnyMissing = isAnyMissing || !picture.bytes;
    }
    if (!isAnyMissing) continue;
    (void)answer.drawn();  // here, where OpenGL is
    (void)answer.mesh.colours.get();
    drawn.push_back(i);
  }
  const std::vector<std::size_t> firsts = firstToLookSo(answers, drawn);
  std::vector<EncodingQueue::Work> encodings;
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    std::vector<Picture>& own = pictures[drawn[k]];
    for (std::size_t p = 0; p < own.size(); ++p) {
      if (own[p].bytes) continue;
      if (firsts[k] != drawn[k]) {
        own[p].same = &pictures[firsts[k]][p];
      } else {
        encodings.emplace_back([this, picture = &own[p]] {
          picture->bytes = picture->make();
          scene_.cache.keep(picture->key, *picture->bytes);
        });
      }
    }
  }
  queue_.add(std::move(encodings), [] {});
  return pictures;
}

void PanelPictures::write(std::vector<Picture>& pictures) {
  for (Picture& picture : pictures) {
    if (picture.same != nullptr) {
      picture.bytes = picture.same->bytes;
      scene_.cache.keep(picture.key, *picture.bytes);
    }
    if (!picture.path.empty()) writer_.write(picture.path, *picture.bytes);
  }
}

std::vector<std::size_t> PanelPictures::firstToLookSo(const std::vector<Answer>& answers,
                                                      const std::vector<std::size_t>& places) {
  std::vector<std::size_t> firsts = firstOfSame(places.size(), [&](std::size_t a, std::size_t b) {
    return answers[places[a]].looksLike(answers[places[b]]);
  });
  for (std::size_t& first : firsts) first = places[first];
  return firsts;
}

std::vector<WorstPlace> PanelPictures::placesOf(const Answer& answer, const Answer& right) const {
  const ShownAnswer own = answer.drawn();
  const ShownAnswer truth = shownOf(*answer.truth);
  const std::vector<float> errors =
      own.isSoft() ? sampleErrors(own.shares, truth.shares) : sampleErrors(own.mask, truth.mask);
  const auto colourOf = [&](const Answer& shown, const ShownAnswer& of) -> SampleColour {
    if (answer.sharesPicture) return [&](std::size_t i) { return shown.mesh.shadingAt(of, i); };
    return [&of](std::size_t i) { return maskGrey(of, i); };
  };
  return worstPlaces(errors, own.mask.width, own.mask.height, colourOf(answer, own),
                     colourOf(right, truth), writer_);
}

void PanelPictures::queuePlaces(const std::vector<Answer>& shown,
                                std::vector<std::vector<WorstPlace>>& places) {
  const Answer& right = shown.back();
  places.resize(shown.size() - 1);
  std::vector<std::size_t> missing;
  const auto keyOf = [this, &shown, &right](std::size_t i) {
    return cache::KeyBuilder("worst places")
        .add("answer", shown[i].key)
        .add("truth", right.key)
        .key();
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    auto found = scene_.cache.find<std::vector<WorstPlace>>(keyOf(i));
    if (found) {
      places[i] = std::move(*found);
      continue;
    }
    missing.push_back(i);
    (void)shown[i].drawn();  // here, where OpenGL is
    if (!shown[i].sharesPicture) continue;
    (void)shown[i].mesh.colours.get();
    (void)right.mesh.colours.get();
  }
  const std::vector<std::size_t> firsts = firstToLookSo(shown, missing);
  std::vector<EncodingQueue::Work> encodings;
  for (std::size_t k = 0; k < missing.size(); ++k) {
    if (firsts[k] != missing[k]) continue;
    encodings.emplace_back(
        [this, &shown, &places, i = missing[k]] { places[i] = placesOf(shown[i], shown.back()); });
  }
  queue_.add(std::move(encodings), [this, &places, missing, firsts, keyOf] {
    for (std::size_t k = 0; k < missing.size(); ++k) {
      if (firsts[k] != missing[k]) places[missing[k]] = places[firsts[k]];
      scene_.cache.keep(keyOf(missing[k]), places[missing[k]]);
    }
  });
}

TruthFilesRecord PanelPictures::queueTruth(std::size_t view, std::size_t light,
                                           const BaseCase& base) {
  const BaseCase& standard = scene_.standardBase();
  const truth::Truth& truth = base.views[view].truths[light];
  const bool crosses =
      std::find(truth.crossesSeam.begin(), truth.crossesSeam.end(), 1) != truth.crossesSeam.end();
  const std::string name = truthName(base, standard, view, light);
  const cache::ContentKey key = cache::KeyBuilder("truth files")
                                    .add("truth", scene_.keys.truth(base.choice, view, light))
                                    .key();
  TruthFilesRecord paths{path("masks", view, light, name), path("regions", view, light, name),
                         crosses ? path("regions", view, light, name + "_seam") : "",
                         writeWeights(view)};
  const auto write = [this, paths, name, crosses](const TruthBytes& bytes) {
    if (name != "truth") writer_.write(paths.mask, bytes.mask);
    writer_.write(paths.regions, bytes.regions);
    if (crosses) writer_.write(paths.seam, bytes.seam);
  };
  if (auto found = scene_.cache.find<TruthBytes>(key)) {
    queue_.add({}, [write, bytes = std::move(*found)] { write(bytes); });
    return paths;
  }
  const auto made = std::make_shared<TruthBytes>();
  std::vector<EncodingQueue::Work> encodings = {
      [this, made, &truth] { made->regions = writer_.regions(truth); },
      [this, made, &truth] { made->mask = maskFile(writer_, shownOf(truth)); }};
  if (crosses) {
    encodings.emplace_back([this, made, &truth] { made->seam = writer_.mask(seamMask(truth)); });
  }
  queue_.add(std::move(encodings), [this, key, made, write] {
    scene_.cache.keep(key, *made);
    write(*made);
  });
  return paths;
}

std::string PanelPictures::writeWeights(std::size_t view) {
  const BaseCase& standard = scene_.standardBase();
  const ViewCase& atlas = standard.views[view];
  if (atlas.weights.empty()) return "";
  std::string file = fmt::format("regions/{}_weights.exr", names_.views[view]);
  if (!viewsWithWeights_.insert(view).second) return file;
  const cache::ContentKey key =
      cache::KeyBuilder("weights").add("samples", scene_.keys.samples(standard.choice, view)).key();
  const std::string bytes = scene_.cache.remember(key, [&] {
    return scene_.clock.measure("writing", [&](const Progress&) {
      return writer_.weights(atlas.samples.width, atlas.samples.height, atlas.weights);
    });
  });
  writer_.write(file, bytes);
  return file;
}

PanelRecord PanelPictures::draw(std::size_t view, std::size_t light,
                                std::span<const PanelAnswer> answers) {
  using Kind = PictureRecord::Kind;
  const StudySpec& study = scene_.study;
  const BaseCase& standard = scene_.standardBase();
  PanelRecord panel;
  panel.view = study.views[view].name;
  panel.light = study.lights[light].name;
  panel.width = standard.views[view].view.width;
  panel.height = standard.views[view].view.height;
  std::map<const BaseCase*, Mesh> meshes;
  const auto meshFor = [&](const BaseCase& base) -> const Mesh& {
    const auto found = meshes.find(&base);
    if (found != meshes.end()) return found->second;
    Mesh& mesh =
        meshes
            .emplace(&base, Mesh{OnDemand<Mesh::Colours>([this, view, light, &base] {
              return Mesh::Colours{shade(view, light, base, Shade::lit), dark(view, light, base)};
            })})
            .first->second;
    // Under a light with a disc no page composes shadings.
    if (!study.lights[light].isSoft()) queueLayers(view, light, base, mesh);
    return mesh;
  };
  std::map<const BaseCase*, TruthFilesRecord> truths;
  const auto truthAt = [&](const BaseCase& base) {
    const auto found = truths.find(&base);
    if (found != truths.end()) return found->second;
    return truths.emplace(&base, queueTruth(view, light, base)).first->second;
  };
  std::vector<Answer> shown;
  for (const PanelAnswer& answer : answers) {
    const BaseCase& base = *answer.method->base;
    shown.push_back({names_.methods[answer.place], answerKey(scene_, *answer.method, view, light),
                     meshFor(base), &base.views[view].truths[light],
                     truthName(base, standard, view, light) == "truth",
                     [&asked = answer.answers] {
                       return ShownAnswer{asked().drawn, asked().drawnShares};
                     },
                     [&asked = answer.answers] {
                       return ShownAnswer{asked().test, asked().testShares};
                     }});
  }
  shown.push_back({"truth", scene_.keys.truth(standard.choice, view, light), meshFor(standard),
                   nullptr, true, [&] { return shownOf(standard.views[view].truths[light]); }});
  std::vector<std::vector<Picture>> pictures = queueAnswers(view, light, shown);
  queue_.add({}, [&] {
    for (std::vector<Picture>& own : pictures) write(own);
  });
  std::vector<std::vector<WorstPlace>> worst;
  queuePlaces(shown, worst);
  for (const PanelAnswer& answer : answers) (void)truthAt(*answer.method->base);
  (void)truthAt(standard);
  queue_.finish();
  // Two meshes that differ in nothing that one sees share theirs.
  const auto layersOf = [&](const Answer& answer) -> std::optional<std::size_t> {
    if (study.lights[light].isSoft()) return std::nullopt;
    const auto place = std::find(panel.layers.begin(), panel.layers.end(), answer.mesh.layers);
    const std::ptrdiff_t found = place - panel.layers.begin();
    if (place == panel.layers.end()) panel.layers.push_back(answer.mesh.layers);
    return static_cast<std::size_t>(found);
  };
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const std::string& label = study.methods[answers[i].place].label;
    panel.pictures.push_back(
        {Kind::shaded, label, label, path("images", view, light, shown[i].name),
         path("masks", view, light, shown[i].name), std::move(*pictures[i].front().bytes),
         layersOf(shown[i]), truthAt(*answers[i].method->base),
         path("masks/test", view, light, shown[i].name), std::move(worst[i])});
  }
  if (const auto displaced = displaced_.find({view, light}); displaced != displaced_.end()) {
    panel.pictures.push_back({Kind::displaced, "truth", "displaced mesh, ray-traced",
                              path("images", view, light, "displaced"), "", displaced->second});
  }
  panel.pictures.push_back({Kind::shaded, "truth", "truth", path("images", view, light, "truth"),
                            path("masks", view, light, "truth"),
                            std::move(*pictures.back().front().bytes), layersOf(shown.back()),
                            truthAt(standard)});
  for (const PanelAnswer& answer : answers) {
    const std::string& label = study.methods[answer.place].label;
    panel.pictures.push_back(
        {Kind::difference, label, label,
         path("images", view, light, names_.methods[answer.place] + "_difference")});
  }
  return panel;
}

}  // namespace gnomon::study

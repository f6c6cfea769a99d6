#include "study/run/stages/panel_pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/lists.h"
#include "common/parallel.h"
#include "image/images.h"
#include "render/passes/drawing.h"
#include "study/run/scene/cached_fields.h"

namespace gnomon::study {

namespace {

/// The colour between two of shade.frag's by a share of light, which is linear before its encoding.
std::uint8_t between(std::uint8_t dark, std::uint8_t lit, double share) {
  constexpr double encoding = 2.2;
  const auto light = [](std::uint8_t value) { return std::pow(value / 255.0, encoding); };
  const double mixed = light(dark) + share * (light(lit) - light(dark));
  return static_cast<std::uint8_t>(std::lround(255 * std::pow(mixed, 1 / encoding)));
}

/// @param rgb  of the sample lit
void shadeSample(const ShownAnswer& shown, std::size_t sample, const RgbPixels& darkColours,
                 std::uint8_t* rgb) {
  const std::uint8_t* dark = &darkColours[3 * sample];
  const double share = shown.isSoft() ? static_cast<double>(shown.shares.shares[sample]) : 0;
  if (share > 0) {
    for (std::size_t k = 0; share < 1 && k < 3; ++k) rgb[k] = between(dark[k], rgb[k], share);
  } else if (shown.mask.samples[sample] == Shade::shadowed) {
    std::copy_n(dark, 3, rgb);
  }
}

/// Of shadowed samples many lie together.
void darkenShadows(const std::vector<Shade>& samples, const RgbPixels& dark, RgbPixels& rgb) {
  for (auto first = samples.begin(); first != samples.end();) {
    first = std::find(first, samples.end(), Shade::shadowed);
    const auto end =
        std::find_if(first, samples.end(), [](Shade shade) { return shade != Shade::shadowed; });
    const auto byte = 3 * (first - samples.begin());
    std::copy_n(dark.begin() + byte, 3 * (end - first), rgb.begin() + byte);
    first = end;
  }
}

}  // namespace

ShownAnswer shownOf(const truth::Truth& truth) {
  return {truth.mask, truth.visibility};
}

RgbPixels shadingOf(const MeshColours& colours, const ShownAnswer& shown) {
  RgbPixels rgb = colours.lit;
  if (shown.isSoft()) {
    for (std::size_t i = 0; i < shown.mask.size(); ++i) {
      shadeSample(shown, i, *colours.dark, &rgb[3 * i]);
    }
  } else {
    darkenShadows(shown.mask.samples, *colours.dark, rgb);
  }
  return rgb;
}

std::array<std::uint8_t, 3> shadingAt(const MeshColours& colours, const ShownAnswer& shown,
                                      std::size_t sample) {
  std::array<std::uint8_t, 3> rgb{};
  std::copy_n(&colours.lit[3 * sample], 3, rgb.data());
  shadeSample(shown, sample, *colours.dark, rgb.data());
  return rgb;
}

std::array<std::uint8_t, 3> maskGrey(const ShownAnswer& shown, std::size_t sample) {
  constexpr std::uint8_t none = image::MaskGreys::none;
  if (shown.mask.samples[sample] == Shade::none) return {none, none, none};
  const float hard = shown.mask.samples[sample] == Shade::lit ? 1.0F : 0.0F;
  const float share = shown.isSoft() ? shown.shares.shares[sample] : hard;
  const auto grey = static_cast<std::uint8_t>(std::lround(255 * share));
  return {grey, grey, grey};
}

std::string maskFile(const RunWriter& writer, const ShownAnswer& shown) {
  return shown.isSoft() ? writer.shares(shown.shares) : writer.mask(shown.mask);
}

std::string differenceFile(const RunWriter& writer, const ShownAnswer& shown,
                           const ShownAnswer& truth) {
  return shown.isSoft() ? writer.difference(shown.shares, truth.shares)
                        : writer.difference(shown.mask, truth.mask);
}

/// An answer of a panel with the keys of its pictures, or the truth. Its mask is asked for only
/// where one of them has to be made.
struct PanelPictures::Answer {
  std::string name;  ///< of its files
  cache::ContentKey key;
  const Mesh& mesh;
  const truth::Truth& truth;  ///< at its own samples
  bool sharesPicture;         ///< whether the truth's picture shows its samples
  const PanelAnswer* asked;   ///< null for the truth itself

  [[nodiscard]] ShownAnswer drawn() const {
    if (asked == nullptr) return shownOf(truth);
    const CaseAnswers& both = asked->answers();
    return {both.drawn, both.drawnShares};
  }
  /// Of the shadow test alone; the truth has none.
  [[nodiscard]] ShownAnswer test() const {
    const CaseAnswers& both = asked->answers();
    return {both.test, both.testShares};
  }
  /// Whether all pictures of two answers are the same. Both are drawn.
  [[nodiscard]] bool looksLike(const Answer& other) const {
    return asked != nullptr && other.asked != nullptr && &truth == &other.truth &&
           &mesh == &other.mesh && answerAlike(asked->answers(), other.asked->answers());
  }
};

/// A mesh in a panel. It is drawn only where a picture of it has to be made.
struct PanelPictures::Mesh {
  OnDemand<MeshColours> colours;
  LayersRecord layers = {};  ///< both as a page embeds them, once the queue is finished
};

PanelPictures::PanelPictures(RunScene& scene, RunWriter& writer)
    : scene_(scene), writer_(writer), output_(scene, writer) {}

void PanelPictures::drawDisplaced(SurfaceOnDemand& surface) {
  displaced_.queue(surface);
}

RgbPixels PanelPictures::shade(std::size_t view, std::size_t light, const BaseCase& base,
                               Shade everywhere) {
  return scene_.clock.measure("pictures", [&](const Progress&) {
    const render::DrawnMesh kind = base.choice.kind;
    const auto pass = scene_.cache.share(
        scene_.keys.shading(kind),
        [&] { return render::ShadePass(scene_.shaders, scene_.study.relief.field.wrap(), kind); },
        programBytes);
    const render::RenderView& seen = base.views[view].view;
    const auto pixels =
        static_cast<std::size_t>(seen.width) * static_cast<std::size_t>(seen.height);
    return pass->render(seen, scene_.drawing(base, light),
                        {seen.width, seen.height, std::vector<Shade>(pixels, everywhere)});
  });
}

std::shared_ptr<const RgbPixels> PanelPictures::dark(std::size_t view, std::size_t light,
                                                     const BaseCase& base) {
  return scene_.cache.share(
      scene_.keys.dark(base.choice, view),
      [&] { return shade(view, light, base, Shade::shadowed); },
      [](const RgbPixels& rgb) { return rgb.size(); });
}

void PanelPictures::queueLayers(std::size_t view, std::size_t light, const BaseCase& base,
                                Mesh& mesh) {
  const cache::ContentKey key = scene_.keys.layers(base.choice, view, light);
  if (auto found = scene_.cache.find<LayersRecord>(key)) {
    mesh.layers = std::move(*found);
    return;
  }
  const MeshColours& colours = mesh.colours.get();
  const render::RenderView& seen = base.views[view].view;
  const auto embed = [this, &seen](const RgbPixels& rgb) {
    return writer_.embedded(seen.width, seen.height, rgb, EmbeddedSize::full);
  };
  std::vector<EncodingQueue::Work> encodings = {
      [embed, &mesh, &colours] { mesh.layers.lit = embed(colours.lit); }};
  const cache::ContentKey darkKey = scene_.keys.dark(base.choice, view);
  if (const auto dark = scene_.cache.shared<std::string>(darkKey)) {
    mesh.layers.dark = *dark;
  } else {
    encodings.emplace_back([embed, &mesh, &colours] { mesh.layers.dark = embed(*colours.dark); });
  }
  output_.queue.add(std::move(encodings), [this, key, darkKey, &mesh] {
    scene_.cache.keep(key, mesh.layers);
    scene_.cache.share(
        darkKey, [&] { return mesh.layers.dark; }, mesh.layers.dark.size());
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
  const auto shaded = [&answer] { return shadingOf(answer.mesh.colours.get(), answer.drawn()); };
  const EmbeddedSize size =
      scene_.study.lights[light].isSoft() ? EmbeddedSize::full : EmbeddedSize::small;
  // The longest first.
  std::vector<Picture> pictures = {{"embedded", "",
                                    [&answer, this, shaded, size] {
                                      const Mask& mask = answer.drawn().mask;
                                      return writer_.embedded(mask.width, mask.height, shaded(),
                                                              size);
                                    }},
                                   {"shaded", output_.path("images", view, light, name),
                                    [&answer, this, shaded] {
                                      const Mask& mask = answer.drawn().mask;
                                      return writer_.picture(mask.width, mask.height, shaded());
                                    }},
                                   {"mask", output_.path("masks", view, light, name),
                                    [&answer, this] { return maskFile(writer_, answer.drawn()); }}};
  if (answer.asked != nullptr) {
    pictures.push_back(
        {"difference", output_.path("images", view, light, name + "_difference"), [&answer, this] {
           return differenceFile(writer_, answer.drawn(), shownOf(answer.truth));
         }});
    pictures.push_back({"test mask", output_.path("masks/test", view, light, name),
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
  output_.queue.add(std::move(encodings), [] {});
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
  const ShownAnswer truth = shownOf(answer.truth);
  const std::vector<compare::Window> squares =
      own.isSoft() ? worstSquares(own.shares, truth.shares) : worstSquares(own.mask, truth.mask);
  const auto colourOf = [&](const Answer& shown, const ShownAnswer& of) -> SampleColour {
    if (answer.sharesPicture)
      return [&](std::size_t i) { return shadingAt(shown.mesh.colours.get(), of, i); };
    return [&of](std::size_t i) { return maskGrey(of, i); };
  };
  return worstPlaces(squares, own.mask.width, colourOf(answer, own), colourOf(right, truth),
                     writer_);
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
  output_.queue.add(std::move(encodings), [this, &places, missing, firsts, keyOf] {
    for (std::size_t k = 0; k < missing.size(); ++k) {
      if (firsts[k] != missing[k]) places[missing[k]] = places[firsts[k]];
      scene_.cache.keep(keyOf(missing[k]), places[missing[k]]);
    }
  });
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
            .emplace(&base, Mesh{OnDemand<MeshColours>([this, view, light, &base] {
              return MeshColours{shade(view, light, base, Shade::lit), dark(view, light, base)};
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
    return truths.emplace(&base, truths_.queue(view, light, base)).first->second;
  };
  std::vector<Answer> shown;
  for (const PanelAnswer& answer : answers) {
    const BaseCase& base = *answer.method->base;
    shown.push_back({output_.names.methods[answer.place],
                     answerKey(scene_, *answer.method, view, light), meshFor(base),
                     base.views[view].truths[light], truths_.nameOf(base, view, light) == "truth",
                     &answer});
  }
  shown.push_back({"truth", scene_.keys.truth(standard.choice, view, light), meshFor(standard),
                   standard.views[view].truths[light], true, nullptr});
  std::vector<std::vector<Picture>> pictures = queueAnswers(view, light, shown);
  output_.queue.add({}, [&] {
    for (std::vector<Picture>& own : pictures) write(own);
  });
  std::vector<std::vector<WorstPlace>> worst;
  queuePlaces(shown, worst);
  for (const PanelAnswer& answer : answers) (void)truthAt(*answer.method->base);
  (void)truthAt(standard);
  output_.queue.finish();
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
        {Kind::shaded, label, label, output_.path("images", view, light, shown[i].name),
         output_.path("masks", view, light, shown[i].name), std::move(*pictures[i].front().bytes),
         layersOf(shown[i]), truthAt(*answers[i].method->base),
         output_.path("masks/test", view, light, shown[i].name), std::move(worst[i])});
  }
  if (const std::string* displaced = displaced_.embedded(view, light)) {
    panel.pictures.push_back({Kind::displaced, "truth", "displaced mesh, ray-traced",
                              output_.path("images", view, light, "displaced"), "", *displaced});
  }
  panel.pictures.push_back(
      {Kind::shaded, "truth", "truth", output_.path("images", view, light, "truth"),
       output_.path("masks", view, light, "truth"), std::move(*pictures.back().front().bytes),
       layersOf(shown.back()), truthAt(standard)});
  for (const PanelAnswer& answer : answers) {
    const std::string& label = study.methods[answer.place].label;
    panel.pictures.push_back(
        {Kind::difference, label, label,
         output_.path("images", view, light, output_.names.methods[answer.place] + "_difference")});
  }
  return panel;
}

}  // namespace gnomon::study

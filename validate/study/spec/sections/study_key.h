#pragma once

#include <toml++/toml.h>

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "cache/content_key.h"
#include "common/vec.h"
#include "study/spec/toml_reader.h"

namespace gnomon::study {

/// The keys of a study's tables. Each section of a study declares its keys once, in a function
/// `keysOf` beside its structure: name, place of the value, range, meaning. What the value is
/// before the key is read is its default. From this declaration come the reader with its messages,
/// the table of all keys (`gnomon list keys`, docs/study-keys.md), the settings in `summary.json`
/// and in the study's copy, and the keys of the cache.

/// The results of a run that depend on a key's value, as flags: the cache computes these again when
/// the value changes. By default a key enters all of them.
enum class Enters : unsigned {
  nothing = 0,     ///< a name or a text, or a value whose effect other keys hold
  horizons = 1,    ///< horizons and distances of the flat relief
  codes = 2,       ///< tables as they are stored, in bits
  flatAngles = 4,  ///< horizon angles of the flat relief
  shotAngles = 8,  ///< horizon angles of the displaced surface
  search = 16,     ///< how far marches go, and the regions of the truth
  scene = 32,      ///< the surface, the meshes and the samples
  answers = 64,    ///< what a method answers
  costs = 128,     ///< frame times
  shares = 256,    ///< the truth's shares of a light's disc
  everything = ~0U
};
constexpr Enters operator|(Enters a, Enters b) {
  return static_cast<Enters>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

/// A value of an enumeration, by the names of its values.
struct ChosenName {
  std::vector<std::string> names;
  bool areNumbers = false;           ///< whether the file has whole numbers in place of strings
  std::function<std::size_t()> get;  ///< index into `names`
  std::function<void(std::size_t)> set;
};

/// @param value  one of the listed ones
template <typename Enum>
ChosenName chosenName(Enum& value, std::vector<std::pair<Enum, std::string>> values,
                      bool areNumbers = false) {
  ChosenName chosen;
  for (const auto& [one, name] : values) chosen.names.push_back(name);
  chosen.areNumbers = areNumbers;
  chosen.get = [&value, values] {
    std::size_t index = 0;
    while (values.at(index).first != value) ++index;
    return index;
  };
  chosen.set = [&value, values](std::size_t index) { value = values.at(index).first; };
  return chosen;
}

/// Numbers beside each other: one, or the components of a vector. The program has them times
/// `scale`, or angles in radians for the file's degrees.
struct Numbers {
  double* first;
  std::size_t count = 1;
  double scale = 1;
  bool areAngles = false;
};
inline Numbers numbers(double& number, double scale = 1) {
  return {&number, 1, scale};
}
inline Numbers numbers(Vec2& pair) {
  return {&pair.x, 2};
}
inline Numbers numbers(Vec3& point) {
  return {&point.x, 3};
}
inline Numbers degrees(double& angle) {
  return {&angle, 1, 1, true};
}

/// A number that may be missing; the program has it times `scale`.
struct OptionalNumber {
  std::optional<double>* number;
  double scale = 1;
};

/// A number, or a list of numbers.
struct NumberOrList {
  std::vector<double>* numbers;
};

/// A value that is written, and enters keys, only where it is not the usual one: a setting that
/// most studies do not speak of.
struct Unusual {
  std::variant<bool*, int*, double*> place;
  double usual = 0;
};

/// A value that the section's own code reads and writes.
struct OwnCode {
  std::string type;  ///< for the table of keys
};

struct StudyKey {
  /// Where the value is, which also says its type.
  using Place = std::variant<std::string*, bool*, int*, glm::ivec2*, Numbers, OptionalNumber,
                             NumberOrList, Unusual, std::vector<Vec3>*, ChosenName, OwnCode>;

  std::string_view name;
  Place place;
  std::string_view meaning;
  NumberRange range;  ///< of a number, of each number of a list; in the file's units
  /// What holds without the key, for the table of keys: the value that is in its place, if empty.
  std::string_view otherwise;
  Enters enters;
  std::vector<std::string> oneOf;  ///< texts that a string may be; any, if empty
};
/// The value of `otherwise` for a key that must be in the file.
constexpr std::string_view required = "required";
using StudyKeys = std::vector<StudyKey>;

/// A key by its members, of which the last have defaults.
inline StudyKey studyKey(std::string_view name, StudyKey::Place place, std::string_view meaning,
                         NumberRange range = anyNumber, std::string_view otherwise = {},
                         Enters enters = Enters::everything, std::vector<std::string> oneOf = {}) {
  return {name, std::move(place), meaning, range, otherwise, enters, std::move(oneOf)};
}

/// The names of the keys.
KeyNames namesOf(const StudyKeys& keys);

/// Reads the keys into their places. A key that is not in the file leaves its place as it is.
/// @throws InputError as TomlReader, for a required key that is missing too
void readKeys(const TomlReader& section, const StudyKeys& keys);

/// Reads a table that has these keys and no others.
void readSection(const TomlReader& section, const StudyKeys& keys);

/// Reads values that stand in no file, under the ranges that they have in a study: arguments of the
/// library. All keys must be known; a message ends with what its key means, and so with its unit.
/// @param name  of the whole, for messages: "camera: fov: 200 found, …"
/// @throws InputError as TomlReader
void readValues(const toml::table& values, const std::string& name, const StudyKeys& keys);

/// The values as a table of the file; unset optional numbers, usual values of `Unusual` and values
/// of `OwnCode` are not in it.
toml::table tableOf(const StudyKeys& keys);

/// Adds the values that enter a result to its key.
void addKeys(cache::KeyBuilder& key, const StudyKeys& keys, Enters result);

/// The type and range of a key in words, "a whole number from 1 to 1024", and its default as TOML
/// or in words, "required" where there is none.
std::string typeText(const StudyKey& key);
std::string defaultText(const StudyKey& key);

// ---- tables of several kinds, told apart by the value of one key

/// A default-constructed value of every alternative of a variant.
template <typename... Kinds>
std::vector<std::variant<Kinds...>> kindsOf(std::type_identity<std::variant<Kinds...>>) {
  return {Kinds{}...};
}
template <typename Variant>
std::vector<Variant> allKinds() {
  return kindsOf(std::type_identity<Variant>{});
}

/// The names of the keys of all kinds, and `tag`.
template <typename Variant>
KeyNames namesOfAllKinds(std::string_view tag, StudyKeys (*keysOf)(Variant&)) {
  KeyNames names = {std::string(tag)};
  for (Variant& kind : allKinds<Variant>()) names.merge(namesOf(keysOf(kind)));
  return names;
}

/// Reads which kind a table is of, and the keys of that kind.
/// @param tag    the key that says it
/// @param names  of all kinds, in the variant's order
template <typename Variant, std::size_t size>
Variant readKind(const TomlReader& section, std::string_view tag,
                 const std::array<std::string_view, size>& names, StudyKeys (*keysOf)(Variant&)) {
  static_assert(size == std::variant_size_v<Variant>);
  Variant kind = allKinds<Variant>().at(section.choice(tag, {names.begin(), names.end()}));
  readKeys(section, keysOf(kind));
  return kind;
}

/// The settings of a section as a table of the file.
/// @param with  what `keysOf` takes after the section
template <typename Section, typename... With>
toml::table settingsOf(Section section, const With&... with) {
  return tableOf(keysOf(section, with...));
}

/// Adds the settings of a section that enter a result to its key.
template <typename Section, typename... With>
void addSettings(cache::KeyBuilder& key, Section section, Enters result, const With&... with) {
  addKeys(key, keysOf(section, with...), result);
}

}  // namespace gnomon::study

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::study {

/// The keys of a sweep, and what its cases give to them.

/// A value of a key.
struct SweptValue {
  std::string text;              ///< as people read it: "0.0025", "columns", "[64, 64]"
  std::optional<double> number;  ///< where it is one
  std::string written;           ///< as a study's file has it: "0.0025", "\"columns\""
  bool operator==(const SweptValue&) const = default;
};

/// A number as a value: its shortest text.
SweptValue sweptNumber(double number);

/// A key that a sweep sets.
struct SweptKey {
  std::string key;   ///< as `--set` takes it
  std::string axis;  ///< what its values are, for a plot's axis
  /// Keys of one dimension step together: they are zipped. The dimensions make a grid.
  /// From 0, in the order of the file.
  std::size_t dimension = 0;
};

/// One point of a sweep.
struct SweepCase {
  std::string name;                ///< its folder in the sweep's
  std::vector<SweptValue> values;  ///< one a key
};

/// The number of dimensions of a sweep.
std::size_t dimensionCount(std::span<const SweptKey> keys);

/// "relief.height = 2", with several keys "relief.height = 2, bake.bits = 8".
std::string caseText(std::span<const SweptKey> keys, const SweepCase& which);

/// The last part of each key, "height"; the whole key where two end alike, also for who takes a
/// letter and its capital for one.
std::vector<std::string> shortNames(std::span<const SweptKey> keys);

/// "relief.height", with several keys "relief.height, bake.bits".
std::string keysText(std::span<const SweptKey> keys);

}  // namespace gnomon::study

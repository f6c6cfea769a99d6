#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/random_stream.h"
#include "common/vec.h"
#include "study/spec/toml/toml_reader.h"

namespace gnomon::study {

/// A number with four significant digits, as they are written in decimals. Its text is the same on
/// every machine unless the number lies within rounding of the middle between two of them.
double roundedNumber(double value);

/// What a number of a suite is drawn from: a list of values, each as probable as the others, so
/// that a draw is one whole number. In the file:
///   { from = 5, to = 75, step = 0.5 }  from, from + step, … to; of six decimals at most
///   { log = [0.05, 0.8] }              1,025 values in geometric progression, each a roundedNumber
///   { among = [8, 12, 16] }            these
///   3                                  this
/// Every value is the same on every machine: it is made with +, ×, / and square roots alone.
class Distribution {
 public:
  explicit Distribution(std::vector<double> values) : values_(std::move(values)) {}

  /// One of the values. Takes one number of the stream, even where there is but one value.
  [[nodiscard]] double draw(RandomStream& random) const;
  [[nodiscard]] const std::vector<double>& values() const { return values_; }

 private:
  std::vector<double> values_;  ///< at least one
};

/// Reads a key's distribution.
/// @param range  of every value
/// @throws InputError as TomlReader
Distribution readDistribution(const TomlReader& section, std::string_view key,
                              NumberRange range = anyNumber);

/// Sine and cosine of an angle in degrees, the same bits on every machine: by their series, with +
/// and × alone. Err by less than 1e-15. A library's own may differ in the last bit.
struct SineCosine {
  double sine, cosine;
};
SineCosine sineCosine(double degrees);

/// The unit vector at an elevation over the xy plane and an azimuth from +x about +z, degrees.
Vec3 exactDirection(double elevation, double azimuth);

}  // namespace gnomon::study

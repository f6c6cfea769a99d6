#pragma once

#include "study/run/stages/run_writer.h"

namespace gnomon::study {

/// Writes nothing: for a run of which only the figures are wanted.
class NoFiles : public RunWriter {
 public:
  [[nodiscard]] std::string mask(const Mask&) const override { return {}; }
  [[nodiscard]] std::string shares(const Visibility&) const override { return {}; }
  [[nodiscard]] std::string regions(const truth::Truth&) const override { return {}; }
  [[nodiscard]] std::string weights(int, int, const std::vector<double>&) const override {
    return {};
  }
  [[nodiscard]] std::string picture(int, int, std::vector<std::uint8_t>) const override {
    return {};
  }
  [[nodiscard]] std::string difference(const Mask&, const Mask&) const override { return {}; }
  [[nodiscard]] std::string difference(const Visibility&, const Visibility&) const override {
    return {};
  }
  [[nodiscard]] std::string embedded(int, int, std::vector<std::uint8_t>,
                                     EmbeddedSize) const override {
    return {};
  }
  [[nodiscard]] std::vector<std::uint8_t> displaced(int, int,
                                                    const std::vector<float>&) const override {
    return {};
  }
  void write(const std::string&, const std::string&) override {}
};

}  // namespace gnomon::study

#include "study/record/swept_value.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

namespace gnomon::study {

SweptValue sweptNumber(double number) {
  const std::string text = fmt::format("{}", number);
  return {text, number, text};
}

std::size_t dimensionCount(std::span<const SweptKey> keys) {
  std::size_t count = 0;
  for (const SweptKey& key : keys) count = std::max(count, key.dimension + 1);
  return count;
}

std::string caseText(std::span<const SweptKey> keys, const SweepCase& which) {
  std::string text;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    text += fmt::format("{}{} = {}", k == 0 ? "" : ", ", keys[k].key, which.values.at(k).text);
  }
  return text;
}

std::vector<std::string> shortNames(std::span<const SweptKey> keys) {
  const auto lastPart = [](const SweptKey& key) { return key.key.substr(key.key.rfind('.') + 1); };
  const auto lowered = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  std::vector<std::string> names;
  for (const SweptKey& key : keys) {
    const auto alike = std::count_if(keys.begin(), keys.end(), [&](const SweptKey& other) {
      return lowered(lastPart(other)) == lowered(lastPart(key));
    });
    names.push_back(alike > 1 ? key.key : lastPart(key));
  }
  return names;
}

std::string keysText(std::span<const SweptKey> keys) {
  std::string text;
  for (const SweptKey& key : keys) text += (text.empty() ? "" : ", ") + key.key;
  return text;
}

}  // namespace gnomon::study

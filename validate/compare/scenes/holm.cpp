#include "compare/scenes/holm.h"

#include <algorithm>
#include <numeric>

namespace gnomon::compare {

bool isRejected(double probability, double allowed) {
  return probability <= allowed * (1 + 1e-9);
}

std::vector<HolmStep> holmSteps(const std::vector<double>& probabilities) {
  std::vector<std::size_t> order(probabilities.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return probabilities[a] < probabilities[b];
  });
  std::vector<HolmStep> steps(probabilities.size());
  HolmStep last{0, 0};
  bool isOver = false;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double left = static_cast<double>(order.size() - k);
    const double probability = probabilities[order[k]];
    last.adjusted = std::max(last.adjusted, std::min(1.0, left * probability));
    if (!isOver) last.allowed = 0.05 / left;
    isOver = isOver || !isRejected(probability, last.allowed);
    steps[order[k]] = last;
  }
  return steps;
}

}  // namespace gnomon::compare

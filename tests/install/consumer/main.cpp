// A program of someone else's: curvature of a sphere, a mask comparison and a picture through the
// installed libraries.

#include <compare/counts.h>
#include <compare/rates.h>
#include <image/images.h>
#include <surface/curvature.h>
#include <surface/shapes.h>
#include <truth/micro_scene.h>
#include <cmath>

int main() {
  const gnomon::LimitSurface surface(gnomon::makeSphere(50, 1, 1, 16, 16));
  const double curvature = gnomon::principalCurvatures(surface.evaluate(100, 0.5, 0.5)).k1;
  const gnomon::Mask truth{2, 1, {gnomon::Shade::lit, gnomon::Shade::shadowed}};
  const gnomon::Mask candidate{2, 1, {gnomon::Shade::lit, gnomon::Shade::lit}};
  const auto error = gnomon::rate(gnomon::countSamples(candidate, truth), "error_rate").value;
  const bool right = std::abs(curvature * 50 - 1) < 1e-3 && error && *error == 0.5 &&
                     !gnomon::MicroScene::embreeVersion().empty() &&
                     gnomon::pngOf(gnomon::maskImage(truth)).starts_with("\x89PNG");
  return right ? 0 : 1;
}

#include "study/run/driver_faults.h"

#include <fmt/core.h>

#include <utility>

#include "study/run/scene/run_keys.h"

namespace gnomon::study {
namespace {

cache::ContentKey driverKey(const render::GlDriver& gl, const std::filesystem::path& shaders) {
  cache::KeyBuilder key("driver");
  key.add("vendor", gl.vendor).add("renderer", gl.renderer).add("gl", gl.version);
  return key.add("shaders", shadersKey(shaders)).key();
}

}  // namespace

DriverFaults::DriverFaults(std::filesystem::path shaders, cache::Cache& kept)
    : driver_(render::currentDriver()),
      shaders_(std::move(shaders)),
      cache_(kept),
      key_(driverKey(driver_, shaders_)) {}

const std::string& DriverFaults::passFault(render::PassKind kind) {
  const auto known = found_.find(kind);
  if (known != found_.end()) return known->second;
  const cache::ContentKey key =
      cache::KeyBuilder("pass").add("driver", key_).add("pass", kind).key();
  return found_
      .emplace(kind, cache_.remember(key, [&] { return render::passFault(kind, shaders_); }))
      .first->second;
}

std::string DriverFaults::faultText(render::PassKind kind, const std::string& fault) const {
  return fmt::format(
      "this OpenGL gets {} wrong: {} in a scene that is known in closed form ({}, {})",
      render::passName(kind), fault, driver_.renderer, driver_.version);
}

std::string DriverFaults::faultOf(const MethodSpec& method, bool isSoft) {
  const auto kinds = render::passesOf(declarationOf(method), method.filter, isSoft);
  for (const render::PassKind kind : kinds) {
    const std::string& fault = passFault(kind);
    if (!fault.empty()) return faultText(kind, fault);
  }
  return "";
}

void DriverFaults::require(render::PassKind kind) {
  const std::string& fault = passFault(kind);
  if (!fault.empty()) {
    throw DriverError(fmt::format("nothing is measured: {}", faultText(kind, fault)));
  }
}

void DriverFaults::requireViews(const StudySpec& study) {
  for (const ViewSpec& view : study.views) {
    require(traitsOf(view).samplesPass);
  }
  require(render::PassKind::pictures);
}

}  // namespace gnomon::study

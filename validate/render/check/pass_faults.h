#pragma once

#include <filesystem>
#include <string>

#include "render/passes/method_pass.h"

// One function a kind of pass: see passFault for what each compares.

namespace gnomon::render::check {

using Shaders = std::filesystem::path;

// samples_check.cpp
std::string cameraFault(const Shaders& shaders);
std::string atlasFault(const Shaders& shaders);

// table_check.cpp
std::string tableFault(const Shaders& shaders, TableFilter filter);
std::string angleFault(const Shaders& shaders);
std::string ellipseFault(const Shaders& shaders);

// bake_check.cpp
std::string bakeFault(const Shaders& shaders, TableFilter filter);

// texture_check.cpp
std::string textureFault(const Shaders& shaders);
std::string ownPassFault(const Shaders& shaders);

// geometry_check.cpp
std::string facetFault(const Shaders& shaders);
std::string lightDepthFault(const Shaders& shaders);
std::string volumeFault(const Shaders& shaders);
std::string ownLightFault(const Shaders& shaders);
std::string cameraPassFault(const Shaders& shaders);

// shares_check.cpp
std::string sharesFault(const Shaders& shaders);

// picture_check.cpp
std::string pictureFault(const Shaders& shaders);

}  // namespace gnomon::render::check

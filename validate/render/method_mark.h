#pragma once

#include <array>
#include <string>
#include <string_view>

namespace gnomon::render {

/// The families that a method's file can name, by what the method knows of the surface. Plots give
/// each a colour of its own.
constexpr std::array<std::string_view, 7> methodFamilies = {
    "control",    // no shadow method: what every method must beat
    "flat",       // tables of the height map as if the surface were flat
    "curvature",  // such tables, corrected by the surface's curvature
    "march",      // the height map, marched toward the light
    "displaced",  // shadows of the displaced mesh
    "engine",     // what engines ship: occlusion and other approximations of tables or marches
    "ours",       // this project's own
};

/// The symbols that it can name. Plots tell the methods of a family apart by them.
constexpr std::array<std::string_view, 9> methodSymbols = {
    "circle", "square", "triangle", "inverted-triangle", "diamond", "pentagon",
    "plus",   "cross",  "star"};

/// What a method's file says of how plots draw it; empty where it says nothing.
struct MethodMark {
  std::string family;  ///< one of methodFamilies
  std::string symbol;  ///< one of methodSymbols
  bool operator==(const MethodMark&) const = default;
};

}  // namespace gnomon::render

#include "report/plots/page_svg.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>

#include "common/error.h"
#include "common/lists.h"
#include "report/plots/method_styles.h"

namespace gnomon::report {
namespace {

constexpr std::array<std::string_view, 11> knownElements = {
    "svg", "g", "path", "use", "text", "tspan", "circle", "rect", "polygon", "polyline", "line"};
constexpr std::array<std::string_view, 29> knownAttributes = {"d",
                                                              "x",
                                                              "y",
                                                              "x1",
                                                              "y1",
                                                              "x2",
                                                              "y2",
                                                              "dx",
                                                              "dy",
                                                              "r",
                                                              "cx",
                                                              "cy",
                                                              "points",
                                                              "width",
                                                              "height",
                                                              "fill",
                                                              "stroke",
                                                              "color",
                                                              "transform",
                                                              "stroke-width",
                                                              "stroke-dasharray",
                                                              "stroke-linecap",
                                                              "stroke-linejoin",
                                                              "text-anchor",
                                                              "font-size",
                                                              "font-weight",
                                                              "font-style",
                                                              "fill-opacity",
                                                              "viewBox"};
constexpr const char* oldHref = "xlink:href";

pugi::xml_document parsed(const std::string& svg) {
  pugi::xml_document document;
  if (!document.load_string(svg.c_str()) || !document.child("svg")) {
    throw InternalError("gnuplot: its SVG cannot be read");
  }
  return document;
}

/// The three bytes of "rgb(  1,   0,   3)" or "#010003".
std::optional<std::array<unsigned, 3>> bytesOf(const char* colour) {
  std::array<unsigned, 3> rgb{};
  if (std::sscanf(colour, "rgb(%u,%u,%u)", &rgb[0], &rgb[1], &rgb[2]) == 3) return rgb;
  if (std::sscanf(colour, "#%2x%2x%2x", &rgb[0], &rgb[1], &rgb[2]) == 3) return rgb;
  return std::nullopt;
}

/// A text as the page holds it, names of a study among them; textOf escapes nothing more.
std::string escaped(std::string_view text) {
  return escapeHtml(text).text();
}

/// Copies what a page needs of gnuplot's elements.
class PageCopy {
 public:
  explicit PageCopy(const PlotSheet& sheet) : sheet_(sheet) {
    for (const auto* colours : {&frameColours(), &sheet.colours}) {
      for (const PlotColour& colour : *colours) variables_.push_back(colour.variable);
    }
  }

  /// Copies the children of one element into another, and leaves empty groups out.
  void copyChildren(const pugi::xml_node& from, pugi::xml_node to) {
    for (const pugi::xml_node& child : from) {
      if (child.type() == pugi::node_pcdata)
        to.append_child(pugi::node_pcdata).set_value(escaped(child.value()).c_str());
      if (child.type() != pugi::node_element ||
          !contains(knownElements, std::string_view(child.name())))
        continue;
      if (isBackground(child)) continue;
      pugi::xml_node copy = to.append_child(child.name());
      copyAttributes(child, copy);
      const bool isValue = std::strncmp(child.attribute("onmousemove").value(),
                                        "gnuplot_svg.showHypertext", 25) == 0;
      if (isValue) markValue(child, copy);
      copyChildren(child, copy);
      const bool isGroup = std::string_view(child.name()) == "g";
      if (isGroup && !copy.first_child()) {
        to.remove_child(copy);
        continue;
      }
      // gnuplot has a group of its own about each value.
      const pugi::xml_node only = copy.first_child();
      if (isGroup && !child.attribute("id") && only.attribute("class") && !only.next_sibling()) {
        to.append_move(only);
        to.remove_child(copy);
        continue;
      }
      // A curve, as far as it is of a method.
      const bool isPlot = std::strncmp(child.attribute("id").value(), "gnuplot_plot_", 13) == 0;
      const std::string method = isPlot ? methodIn(copy) : "";
      if (!method.empty()) copy.append_attribute("data-method") = method.c_str();
    }
  }

 private:
  [[nodiscard]] bool isBackground(const pugi::xml_node& node) const {
    return std::string_view(node.name()) == "rect" &&
           node.attribute("width").as_int() == sheet_.width &&
           node.attribute("height").as_int() == sheet_.height &&
           node.attribute("x").as_int() == 0 &&
           std::string_view(node.attribute("fill").value()) == "#ffffff";
  }

  /// The variable of the method whose colour something in a group has; empty where nothing has one.
  static std::string methodIn(const pugi::xml_node& group) {
    constexpr std::string_view begin = "var(--plot-";
    const pugi::xml_node found = group.find_node([&](const pugi::xml_node& node) {
      return std::string_view(node.attribute("color").value()).starts_with("var(--plot-method") ||
             std::string_view(node.attribute("stroke").value()).starts_with("var(--plot-method");
    });
    if (!found) return {};
    std::string text = found.attribute("color").value();
    if (!text.starts_with("var(--plot-method")) text = found.attribute("stroke").value();
    return text.substr(begin.size(), text.size() - begin.size() - 1);
  }

  /// Whether every element has it anyway.
  static bool isDefault(const pugi::xml_attribute& attribute) {
    const std::string_view value = attribute.value();
    return value == "butt" || value == "miter";
  }

  void copyAttributes(const pugi::xml_node& from, pugi::xml_node to) {
    for (const pugi::xml_attribute& attribute : from.attributes()) {
      const std::string_view name = attribute.name();
      if (name == oldHref) to.append_attribute("href") = escaped(attribute.value()).c_str();
      if (!contains(knownAttributes, name) || isDefault(attribute)) continue;
      to.append_attribute(attribute.name()) = escaped(shown(attribute.value())).c_str();
    }
  }

  /// The page's colour for one that stands for an index (indexColour), and for gnuplot's black.
  std::string shown(const char* value) {
    if (std::string_view(value) == "black" && !sheet_.isShaded) return "var(--plot-ink)";
    const auto rgb = bytesOf(value);
    if (!rgb || rgb->at(0) != 1 || sheet_.isShaded) return value;
    const std::size_t index = 256 * rgb->at(1) + rgb->at(2);
    if (index >= variables_.size()) return value;
    return fmt::format("var(--plot-{})", variables_[index]);
  }

  void markValue(const pugi::xml_node& from, pugi::xml_node to) const {
    // gnuplot_svg.showHypertext(evt,'12')
    const char* quote = std::strchr(from.attribute("onmousemove").value(), '\'');
    const auto index =
        static_cast<std::size_t>(quote == nullptr ? 0 : std::strtoul(quote + 1, nullptr, 10));
    if (quote == nullptr || index >= sheet_.values.size()) {
      throw InternalError("gnuplot: its SVG has a value that the plot lacks");
    }
    to.append_attribute("class") = "value";
    to.append_child("title")
        .append_child(pugi::node_pcdata)
        .set_value(escaped(sheet_.values[index]).c_str());
  }

  const PlotSheet& sheet_;
  std::vector<std::string> variables_;
};

std::string textOf(const pugi::xml_node& node) {
  std::ostringstream text;
  node.print(text, "", pugi::format_raw | pugi::format_no_declaration | pugi::format_no_escapes);
  return text.str();
}

std::string properties(std::string_view FamilyColours::*ofFamily,
                       std::string PlotColour::*ofFrame) {
  std::string text;
  for (const PlotColour& colour : frameColours()) {
    text += fmt::format("--plot-{}:{};", colour.variable, colour.*ofFrame);
  }
  for (const FamilyColours& family : familyColours) {
    text += fmt::format("--plot-{}:{};", family.family, family.*ofFamily);
  }
  return text + fmt::format("--plot-other:{}", otherMethods.*ofFamily);
}

}  // namespace

Html pageSvg(const std::string& svg, const PlotSheet& sheet) {
  const pugi::xml_document document = parsed(svg);
  pugi::xml_document page;
  pugi::xml_node root = page.append_child("svg");
  root.append_attribute("viewBox") = fmt::format("0 0 {} {}", sheet.width, sheet.height).c_str();
  root.append_attribute("role") = "img";
  root.append_attribute("aria-label") = escaped(sheet.about).c_str();
  if (!sheet.values.empty()) root.append_attribute("tabindex") = "0";
  PageCopy(sheet).copyChildren(document.child("svg"), root);
  return Html(textOf(root));
}

Html plotSymbols(const std::string& svg) {
  const pugi::xml_document document = parsed(svg);
  pugi::xml_document page;
  pugi::xml_node root = page.append_child("svg");
  root.append_attribute("class") = "unseen";
  root.append_attribute("aria-hidden") = "true";
  pugi::xml_node symbols = root.append_child("defs");
  for (const pugi::xml_node& shape : document.child("svg").child("g").child("defs")) {
    if (std::strncmp(shape.attribute("id").value(), "gpPt", 4) != 0) continue;
    pugi::xml_node copy = symbols.append_copy(shape);
    // Its older name, which HTML does not know.
    if (copy.attribute(oldHref)) copy.attribute(oldHref).set_name("href");
  }
  return Html(textOf(root));
}

Html plotProperties() {
  return Html(fmt::format(":root{{{}}}\n@media (prefers-color-scheme:dark){{:root{{{}}}}}\n",
                          properties(&FamilyColours::onWhite, &PlotColour::onWhite),
                          properties(&FamilyColours::onDark, &PlotColour::onDark)));
}

std::string methodProperties(const PlotSheet& sheet) {
  std::string text;
  for (const PlotColour& colour : sheet.colours) {
    const bool isOther = colour.onWhite == otherMethods.onWhite;
    text += fmt::format("--plot-{}:var(--plot-{});", colour.variable,
                        isOther ? std::string(otherMethods.family) : colour.family);
  }
  return text;
}

}  // namespace gnomon::report

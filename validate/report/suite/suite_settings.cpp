#include "report/suite/suite_settings.h"

#include <fmt/core.h>

#include "report/text/number_text.h"
#include "study/spec/toml/toml_text.h"

namespace gnomon::report {
namespace {

using Q = Quantity;

std::string valueText(const study::TriedValue& value) {
  return value.value.empty() ? "as declared" : value.value;
}

/// "# max-forsyth, bake.azimuths: 32 1.20 %, 16 1.54 %, 64 1.08 % (chosen); 200 scenes"
std::string commentOf(const study::SuiteMethods& methods, const study::TriedSetting& setting) {
  std::string text =
      fmt::format("# {}, {}:", study::labelOfMethod(methods.methods[setting.method]), setting.key);
  for (std::size_t i = 0; i < setting.values.size(); ++i) {
    const study::TriedValue& value = setting.values[i];
    text += fmt::format("{} {} {} %{}", i == 0 ? "" : ",", valueText(value),
                        percentText(value.mean), i == setting.best ? " (chosen)" : "");
  }
  return text + fmt::format("; {} scenes\n", setting.scenes);
}

}  // namespace

Table suiteSettingsTable(const study::SuiteMethods& methods,
                         const std::vector<study::TriedSetting>& tried) {
  Table table{.kind = "suite-settings",
              .columns = {{.name = "Method", .quantity = Q::name},
                          {.name = "Setting", .quantity = Q::code},
                          {.name = "Value", .quantity = Q::text},
                          {.name = "Mean", .key = "mean_error_rate", .quantity = Q::percent},
                          {.name = "Scenes", .quantity = Q::count},
                          {.name = "Chosen", .quantity = Q::text}}};
  for (const study::TriedSetting& setting : tried) {
    for (std::size_t i = 0; i < setting.values.size(); ++i) {
      const study::TriedValue& value = setting.values[i];
      const std::string note = i != setting.best ? "" : (i == 0 ? "the authors'" : "chosen");
      table.rows.push_back({{textCell(study::labelOfMethod(methods.methods[setting.method])),
                             textCell(setting.key), textCell(valueText(value)),
                             valueCell(value.mean), countCell(setting.scenes), textCell(note)}});
    }
  }
  return table;
}

std::string chosenSettingsText(const study::SuiteMethods& methods,
                               const std::vector<study::TriedSetting>& tried,
                               const std::string& scenes) {
  std::string text = fmt::format(
      "# Settings with the least mean error on {}, one at a time; the authors' value first.\n",
      scenes);
  for (const study::TriedSetting& setting : tried) text += commentOf(methods, setting);
  toml::array chosen;
  for (toml::table& method : study::chosenMethods(methods, tried)) {
    chosen.push_back(std::move(method));
  }
  if (chosen.empty()) return text;  // every authors' value was the best
  return text + "\n" + study::tomlText(toml::table{{"method", std::move(chosen)}});
}

}  // namespace gnomon::report

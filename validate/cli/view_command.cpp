#include "cli/view_command.h"

#include <CLI/CLI.hpp>

#include "cli/list_option.h"

namespace gnomon {
namespace {

constexpr const char* viewExamples = R"(
Drag turns the surface, L and drag moves the light, ? lists all keys. What is saved goes to
OUT/NAME/view. A pane shows a method, truth, displaced, or a difference, as onoue-2004:truth.

Examples:
  gnomon view scenes/figure8.toml
  gnomon view scenes/figure8.toml --show onoue-2004 --show onoue-2004:truth
  gnomon view scenes/figure8.toml --show max-forsyth --show onoue-2004 --show displaced --show truth
  gnomon view scenes/figure8.toml --overlay section --cursor 420,330 --screenshot view.png)";

}  // namespace

CLI::App* addViewCommand(CLI::App& app, ViewRequest& request) {
  constexpr int smallestSide = 64;
  constexpr int largestSide = 8192;
  CLI::App* view = app.add_subcommand("view", "Open a window: methods, truth and difference, live");
  view->add_option("STUDY", request.study, "Study file")->required()->type_name("FILE");
  view->add_option("--out", request.out, "Folder for what is saved")
      ->capture_default_str()
      ->type_name("DIR");
  addList(*view, "--set", request.options.overrides,
          "Override a key of the study, as relief.height=4 or light.0.elevation=30", "KEY=VALUE");
  addList(*view, "--show", request.show,
          "What a pane shows; given once, twice or four times: so many panes", "CONTENT");
  addList(*view, "--overlay", request.overlays,
          "Drawn over the panes: curvature, directions, section", "NAME")
      ->check(CLI::IsMember({"curvature", "directions", "section"}));
  view->add_option("--width", request.width, "Of the window, pixels")
      ->capture_default_str()
      ->check(CLI::Range(smallestSide, largestSide))
      ->type_name("N");
  view->add_option("--height", request.height, "Of the window, pixels")
      ->capture_default_str()
      ->check(CLI::Range(smallestSide, largestSide))
      ->type_name("N");
  view->add_flag("!--no-panel", request.panel, "Without the controls");
  view->add_flag("--keys", request.help, "With the list of keys");
  view->add_option("--screenshot", request.screenshot,
                   "Render the window's content without a display, with the whole truth, and leave")
      ->type_name("PNG");
  view->add_option("--cursor", request.cursor, "Where the cursor is in a screenshot, pixels")
      ->delimiter(',')
      ->expected(2)
      ->type_name("X,Y");
  view->add_flag("--frames", request.frames, "Print how long frames took, at the end");
  view->add_option("--status", request.status,
                   "Keep a JSON file of what is on the screen, for scripts that drive the window")
      ->type_name("FILE");
  view->footer(viewExamples);
  return view;
}

}  // namespace gnomon

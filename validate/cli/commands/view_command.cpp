#include "cli/commands/view_command.h"

#include <CLI/CLI.hpp>

#include "cli/commands/run_command.h"

namespace gnomon::cli {

namespace {

constexpr const char* viewExamples = R"(
Drag turns the surface, L and drag moves the light, Shift and drag draws a rectangle that tells its
own error, ? lists all keys. Files are saved in OUT/NAME/view. A pane shows a method, truth,
displaced, or a difference such as onoue-2004:truth.

Examples:
  gnomon view scenes/figure8.toml
  gnomon view scenes/figure8.toml --show onoue-2004 --show onoue-2004:truth
  gnomon view scenes/figure8.toml --show max-forsyth --show onoue-2004 --show displaced --show truth
  gnomon view scenes/figure8.toml --overlay section --cursor 420,330 --screenshot view.png
  gnomon view scenes/figure8.toml --light-path 165,24,165,70 --light-frames 24 --record evening)";

}  // namespace

CLI::App* addViewCommand(CLI::App& app, ViewRequest& request) {
  constexpr int smallestSide = 64;
  constexpr int largestSide = 8192;
  CLI::App* view =
      app.add_subcommand("view", "Open a window with methods, truth and their difference");
  view->add_option("STUDY", request.study, "Study file")->required()->type_name("FILE");
  view->add_option("--out", request.out, "Folder for saved files")
      ->capture_default_str()
      ->type_name("DIR");
  addList(*view, "--set", request.options.overrides,
          "Override a key of the study, as relief.height=4 or light.0.elevation=30", "KEY=VALUE");
  addList(*view, "--show", request.show,
          "Content of a pane; once, twice or four times for one, two or four panes; by default the "
          "study's first method other than unshadowed, and the truth",
          "CONTENT");
  addList(*view, "--overlay", request.overlays,
          "Overlay on the panes: curvature, directions, section or pixel", "NAME")
      ->check(CLI::IsMember({"curvature", "directions", "section", "pixel"}));
  view->add_option("--width", request.width, "Width of the window, pixels")
      ->capture_default_str()
      ->check(CLI::Range(smallestSide, largestSide))
      ->type_name("N");
  view->add_option("--height", request.height, "Height of the window, pixels")
      ->capture_default_str()
      ->check(CLI::Range(smallestSide, largestSide))
      ->type_name("N");
  view->add_flag("!--no-panel", request.panel, "Hide the controls");
  view->add_flag("--keys", request.help, "Show the list of keys");
  view->add_option(
          "--screenshot", request.screenshot,
          "Render the content of the window without a display, with the complete truth, and exit")
      ->type_name("PNG");
  view->add_option(
          "--rectangle", request.rectangle,
          "Rectangle that tells its own error: its left, top, right and bottom, percent of "
          "the picture")
      ->delimiter(',')
      ->expected(4)
      ->type_name("L,T,R,B");
  CLI::Option* record =
      view->add_option("--record", request.record,
                       "Record the panes along the light path into a new folder without a display, "
                       "each picture with the complete truth, and a film where ffmpeg is "
                       "installed, and exit")
          ->type_name("DIR");
  constexpr int mostFrames = 9999;
  view->add_option("--light-path", request.lightPath,
                   "Path of the light to record: around, or azimuth and elevation of its start and "
                   "its end, degrees")
      ->needs(record)
      ->capture_default_str()
      ->type_name("PATH");
  view->add_option("--light-frames", request.lightFrames, "Pictures along that path")
      ->needs(record)
      ->capture_default_str()
      ->check(CLI::Range(1, mostFrames))
      ->type_name("N");
  view->add_option("--cursor", request.cursor, "Position of the cursor in a screenshot, pixels")
      ->delimiter(',')
      ->expected(2)
      ->type_name("X,Y");
  view->add_flag("--frames", request.frames, "Print the frame times at the end");
  view->footer(viewExamples);
  return view;
}

}  // namespace gnomon::cli

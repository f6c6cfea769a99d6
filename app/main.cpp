#include "cli/command_line.h"
#include "viewer/window/open_viewer.h"

int main(int argc, char** argv) {
  return gnomon::cli::runCommandLine(argc, argv, gnomon::app::openViewer);
}

// Runs a study: `study STUDY OUT`. It takes the shaders and image formats that are installed with
// the library, not those of the sources.
#include <gnomon/study.h>

#include <cstdio>

int main(int, char** arguments) {
  const gnomon::RunResult result =
      gnomon::runStudy(arguments[1], {.out = arguments[2], .cache = false});
  std::puts(result.passed ? "study: passed" : "study: failed");
}

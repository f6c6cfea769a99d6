#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "common/error.h"

namespace gnomon::test {

/// A file of this process alone, written over for every input.
inline std::filesystem::path fuzzFile(std::string_view extension) {
  static const std::string stem =
      (std::filesystem::temp_directory_path() / ("gnomon-fuzz-" + std::to_string(::getpid())))
          .string();
  return stem + std::string(extension);
}

/// Gives the bytes to a reader as a file. A reader may take them or refuse them with one line; an
/// error that no input should be able to cause, or a message of two lines, ends the process, and
/// with it the search.
/// @param read  called with the file's path
template <typename Read>
void fuzzReader(const std::uint8_t* data, std::size_t size, std::string_view extension,
                const Read& read) {
  const std::filesystem::path path = fuzzFile(extension);
  {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  try {
    read(path);
  } catch (const InternalError& error) {
    std::fprintf(stderr, "an internal error: %s\n", error.what());
    std::abort();
  } catch (const Error& error) {
    const std::string_view message = error.what();
    if (message.empty() || message.find('\n') != std::string_view::npos) {
      std::fprintf(stderr, "not one line: %s\n", error.what());
      std::abort();
    }
  }
}

}  // namespace gnomon::test

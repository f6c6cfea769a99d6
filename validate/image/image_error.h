#pragma once

#include <stdexcept>

namespace gnomon {

/// An image that a library cannot read or write, in its words. These do not name the file and may
/// be of several lines or of none: who asked for the image says the rest.
class ImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gnomon

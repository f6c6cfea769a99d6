#pragma once

#include <filesystem>
#include <optional>

namespace gnomon::image {

/// What the frame header of a JPEG states (ITU-T T.81, B.2.2).
struct JpegFrame {
  int width = 0;
  int height = 0;
  int components = 0;
};

/// The first frame header of a file; none where it has none. Looked up before libjpeg is asked,
/// which takes memory for all coefficients of a progressive picture before it decodes any.
std::optional<JpegFrame> jpegFrame(const std::filesystem::path& path);

}  // namespace gnomon::image

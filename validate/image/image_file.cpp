#include "image/image_file.h"

#include <fmt/core.h>

#include <array>
#include <exception>
#include <fstream>
#include <new>
#include <system_error>
#include <utility>

#include "common/error.h"
#include "common/system/memory.h"
#include "common/text.h"
#include "image/formats/picture_headers.h"
#include "image/formats/png.h"

namespace gnomon::image {
namespace {
namespace fs = std::filesystem;

std::string startOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, imageStartBytes> start{};
  file.read(start.data(), start.size());
  return {start.data(), static_cast<std::size_t>(file.gcount())};
}

/// What the exception that is being handled says.
std::string currentMessage() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return "its reader asks for more memory than there is";
  } catch (const std::exception& error) {
    const std::string message = error.what();
    return message.empty() ? "its reader gives no reason" : message;
  } catch (...) {
    return "its reader gives no reason";
  }
}

}  // namespace

ImageFile::ImageFile(fs::path path) : path_(std::move(path)) {
  std::error_code failure;
  if (!fs::is_regular_file(path_, failure)) refuse("no such file, an image was expected");
  bytes_ = fs::file_size(path_, failure);
  const std::string start = startOf(path_);
  const auto format = imageFormatOf(start);
  if (!format) {
    refuse(fmt::format("not an image that can be read: {} found, {} expected", otherFileKind(start),
                       imageFormatNames));
  }
  format_ = *format;
  if (format_ == ImageFormat::jpeg) {
    // Of a progressive one the reader holds all coefficients, of 16 bits each.
    const JpegFrame frame = jpegFrame(path_).value_or(JpegFrame{});
    requireRoom({frame.width, frame.height, static_cast<double>(frame.components)}, "",
                2.0 * frame.components);
  }
  const ImageModule* module = format_ == ImageFormat::png ? nullptr : &imageModule();
  try {
    if (format_ == ImageFormat::exr) requireSoundExrHeader(path_);
    if (format_ == ImageFormat::bmp) requireSoundBmpHeader(path_);
    reader_ = module == nullptr ? openPng(path_) : module->open(path_, format_);
  } catch (...) {
    refuse(fmt::format("not an image that can be read: a damaged {}: {}", nameOf(format_),
                       currentMessage()));
  }
}

ImageFacts ImageFile::facts() const {
  ImageFacts facts = reader_->facts();
  if (facts.display.width < 1 || facts.display.height < 1) facts.display = facts.data;
  return facts;
}

bool ImageFile::goTo(int part) {
  try {
    return reader_->goTo(part);
  } catch (...) {
    refuse(fmt::format("its part {} cannot be read: {}", part, currentMessage()));
  }
}

void ImageFile::requireReadable(double bytesKept) const {
  const ImageFacts facts = this->facts();
  const auto [width, height] = std::pair(facts.data.width, facts.data.height);
  if (width < 1 || height < 1 || facts.depth > 1 || facts.isDeep || facts.channels.empty()) {
    refuse(fmt::format("{} × {} × {} {}pixels found, a flat image expected", width, height,
                       facts.depth, facts.isDeep ? "deep " : ""));
  }
  requireRoom({width, height, facts.bytesAPixel}, facts.coding, bytesKept);
}

void ImageFile::requireRoom(const Size& size, const std::string& coding, double bytesKept) const {
  const double pixels = static_cast<double>(size.width) * size.height;
  const double unpacked = pixels * size.bytesAPixel;
  const auto bytes = static_cast<double>(bytes_);
  if (unpacked > mostBytesAByteHolds(format_, coding) * bytes) {
    refuse(
        fmt::format("a damaged {}: its header states {} × {} pixels of {}, more than a file of {} "
                    "holds",
                    nameOf(format_), size.width, size.height, formatBytes(size.bytesAPixel),
                    formatBytes(bytes)));
  }
  // Some readers hold the whole picture as the file's own numbers.
  requireMemory(
      unpacked + pixels * bytesKept,
      fmt::format("{}: an image of {} × {} pixels", path_.string(), size.width, size.height));
}

void ImageFile::readRows(int rows, int first, int end, float* values) {
  try {
    reader_->readRows(rows, first, end, values);
  } catch (...) {
    refuse(fmt::format("its pixels cannot be read: {}", currentMessage()));
  }
}

int ImageFile::rowsAtOnce(const ImageFacts& facts, int channels) {
  constexpr std::int64_t mostNumbers = 1 << 20;
  constexpr std::int64_t mostRows = 64;
  const std::int64_t rowNumbers = static_cast<std::int64_t>(facts.data.width) * channels;
  return static_cast<int>(
      std::clamp<std::int64_t>(mostNumbers / std::max<std::int64_t>(rowNumbers, 1), 1, mostRows));
}

void ImageFile::refuse(const std::string& what) const {
  throw InputError(fmt::format("{}: {}", path_.string(), oneLine(what)));
}

}  // namespace gnomon::image

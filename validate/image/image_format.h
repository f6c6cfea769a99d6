#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::image {

/// The formats of pictures that are read: what height maps and masks come in. Each has a reader
/// that is fuzzed; a reader of any other format is never asked.
enum class ImageFormat { exr, png, tiff, jpeg, hdr, pnm, pfm, bmp, tga };

/// "EXR, PNG, TIFF, JPEG, HDR, PNM, PFM, BMP or TGA", for messages.
constexpr const char* imageFormatNames = "EXR, PNG, TIFF, JPEG, HDR, PNM, PFM, BMP or TGA";

/// "EXR", "PNG" …
const char* nameOf(ImageFormat format);

/// How many bytes of a file's start tell its format.
constexpr std::size_t imageStartBytes = 64;

/// The format of a file by its content, whatever its name: by the bytes that it begins with, or for
/// a TGA, which has none of its own, by a header that only a TGA can have.
/// @param start  the file's first `imageStartBytes`, or all of a shorter file
std::optional<ImageFormat> imageFormatOf(std::string_view start);

/// What a file is that is in none of these formats: "a GIF picture", "a Softimage picture", "an
/// empty file", "a file of an unknown kind".
std::string otherFileKind(std::string_view start);

}  // namespace gnomon::image

#pragma once

#include <string>
#include <string_view>

namespace gnomon {

/// The SHA-256 of bytes (FIPS 180-4) as 64 lowercase hexadecimal digits: what `sha256sum` prints.
/// @throws InternalError where the library refuses
std::string sha256(std::string_view bytes);

/// Bytes in Base64 (RFC 4648, section 4), padded, in one line.
std::string base64(std::string_view bytes);

}  // namespace gnomon

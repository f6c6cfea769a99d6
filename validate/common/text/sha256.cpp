#include "common/text/sha256.h"

#include <fmt/core.h>
#include <openssl/evp.h>

#include <array>

#include "common/error.h"

namespace gnomon {

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) {
    throw InternalError("SHA-256: OpenSSL's libcrypto refuses to compute it");
  }
  std::string text;
  for (unsigned int i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

std::string base64(std::string_view bytes) {
  std::string text((bytes.size() + 2) / 3 * 4, '\0');
  const auto* in = reinterpret_cast<const unsigned char*>(bytes.data());
  // It ends its text with a zero, which a string has room for.
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), in,
                  static_cast<int>(bytes.size()));
  return text;
}

}  // namespace gnomon

#include "common/text/base64.h"

#include <openssl/evp.h>

namespace gnomon {

std::string base64(std::string_view bytes) {
  std::string text((bytes.size() + 2) / 3 * 4, '\0');
  const auto* in = reinterpret_cast<const unsigned char*>(bytes.data());
  // It ends its text with a zero, which a string has room for.
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), in,
                  static_cast<int>(bytes.size()));
  return text;
}

}  // namespace gnomon

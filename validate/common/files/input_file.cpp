#include "common/files/input_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <openssl/evp.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <limits>
#include <system_error>

#include "common/error.h"
#include "common/system/memory.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void failToRead(const fs::path& path, int code) {
  throw InputError(
      fmt::format("{}: cannot be read: {}", path.string(), std::generic_category().message(code)));
}

/// What a file is, where it is none to read from.
const char* kindName(fs::file_type type) {
  switch (type) {
    case fs::file_type::directory:
      return "a folder";
    case fs::file_type::fifo:
      return "a FIFO";
    case fs::file_type::socket:
      return "a socket";
    default:
      return "a device";
  }
}

/// What there is of a name, links followed; `not_found` where there is nothing.
fs::file_type typeOf(const fs::path& path) {
  std::error_code failure;
  const fs::file_type type = fs::status(path, failure).type();
  const bool isMissing =
      failure == std::errc::no_such_file_or_directory || failure == std::errc::not_a_directory;
  if (failure && !isMissing) failToRead(path, failure.value());
  return type;
}

/// An open file, which it closes at last.
class Descriptor {
 public:
  /// @param number  negative where it could not be opened
  Descriptor(int number, const fs::path& path) : number_(number) {
    if (number_ < 0) failToRead(path, errno);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { ::close(number_); }

  /// @return how many bytes were read; 0 at the end
  std::size_t read(char* bytes, std::size_t count, const fs::path& path) const {
    for (;;) {
      const ssize_t taken = ::read(number_, bytes, count);
      if (taken >= 0) return static_cast<std::size_t>(taken);
      if (errno == EAGAIN) {
        // Whoever gave us the stream has it return at once.
        pollfd stream{number_, POLLIN, 0};
        (void)::poll(&stream, 1, -1);
      } else if (errno != EINTR) {
        failToRead(path, errno);
      }
    }
  }

 private:
  int number_;
};

/// @param expected  bytes; more and fewer may come
/// @param most      bytes; it stops beyond
std::string readToEnd(const Descriptor& file, const fs::path& path, std::size_t expected,
                      std::size_t most) {
  constexpr std::size_t step = std::size_t{1} << 16U;
  std::string bytes;
  bytes.resize(expected + 1);  // one more, at which the end shows
  std::size_t filled = 0;
  while (const std::size_t taken = file.read(bytes.data() + filled, bytes.size() - filled, path)) {
    filled += taken;
    if (filled > most) break;
    if (filled < bytes.size()) continue;
    requireMemory(static_cast<double>(filled), path.string());
    bytes.resize(2 * filled + step);
  }
  bytes.resize(filled);
  return bytes;
}

/// The descriptor that a given stream's name stands for; -1 where it is none.
int numberOf(const fs::path& path) {
  const std::string name = path.lexically_normal().filename().string();
  if (name == "stdin") return STDIN_FILENO;
  int number = -1;
  const char* end = name.data() + name.size();
  return std::from_chars(name.data(), end, number).ptr == end ? number : -1;
}

}  // namespace

void requireFile(const fs::path& path) {
  const fs::file_type type = typeOf(path);
  if (type == fs::file_type::regular) return;
  if (type == fs::file_type::not_found) {
    throw InputError(fmt::format("{}: no such file", path.string()));
  }
  throw InputError(fmt::format("{}: is {}, a file was expected", path.string(), kindName(type)));
}

bool isThere(const fs::path& path) {
  return typeOf(path) != fs::file_type::not_found;
}

std::string readBytes(const fs::path& path) {
  std::error_code unknown;
  const std::uintmax_t size = fs::file_size(path, unknown);
  const std::size_t expected = unknown ? 0 : static_cast<std::size_t>(size);
  requireMemory(static_cast<double>(expected), path.string());
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC), path);
  return readToEnd(file, path, expected, std::numeric_limits<std::size_t>::max());
}

bool isGivenStream(const fs::path& path) {
  const fs::path name = path.lexically_normal();
  return name == "/dev/stdin" || name.parent_path() == "/dev/fd" ||
         name.parent_path() == "/proc/self/fd";
}

std::string readFileOrStream(const fs::path& path) {
  constexpr std::size_t most = std::size_t{1} << 26U;
  if (!isGivenStream(path) || typeOf(path) != fs::file_type::fifo) {
    requireFile(path);
    return readBytes(path);
  }
  // To open it anew could wait for another writer.
  const Descriptor stream(::dup(numberOf(path)), path);
  std::string bytes = readToEnd(stream, path, 0, most);
  if (bytes.size() > most) {
    throw InputError(fmt::format("{}: more than {} found", path.string(),
                                 formatBytes(static_cast<double>(most))));
  }
  return bytes;
}

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

#include "cache/byte_stream.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnomon::cache {
namespace {

struct Part {
  int number = 0;
  std::string text;
  bool operator==(const Part&) const = default;
};

template <typename Stream, SameAs<Part> T>
void fields(Stream& stream, T& part) {
  stream(part.number, part.text);
}

struct Whole {
  std::vector<Part> parts;
  std::optional<double> value;
  std::vector<float> numbers;
  std::vector<std::vector<std::uint8_t>> lists;
  bool operator==(const Whole&) const = default;
};

template <typename Stream, SameAs<Whole> T>
void fields(Stream& stream, T& whole) {
  stream(whole.parts, whole.value, whole.numbers, whole.lists);
}

Whole sample() {
  return {{{1, "one"}, {-2, std::string("nul\0in it", 9)}},
          std::numeric_limits<double>::denorm_min(),
          {0.1F, -0.0F},
          {{1, 2, 3}, {}}};
}

TEST(ByteStream, ValuesSurviveTheTrip) {
  EXPECT_EQ(valueOf<Whole>(bytesOf(sample())), sample());
  EXPECT_EQ(valueOf<Whole>(bytesOf(Whole{})), Whole{});
  const Whole back = valueOf<Whole>(bytesOf(sample()));
  EXPECT_TRUE(std::signbit(back.numbers[1]));
}

TEST(ByteStream, EveryCutIsSeen) {
  const std::string bytes = bytesOf(sample());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW((void)valueOf<Whole>(bytes.substr(0, size)), DamagedBytes) << size;
  }
  EXPECT_THROW((void)valueOf<Whole>(bytes + "x"), DamagedBytes);
}

TEST(ByteStream, AFlagIsZeroOrOne) {
  EXPECT_EQ(valueOf<std::optional<char>>(std::string("\1x")), 'x');
  for (const char* flag : {"\2x", "\xffx"}) {
    EXPECT_THROW((void)valueOf<std::optional<char>>(flag), DamagedBytes);
  }
}

TEST(ByteStream, LyingSizesAllocateNothing) {
  const std::string huge = bytesOf(std::numeric_limits<std::uint64_t>::max());
  EXPECT_THROW((void)valueOf<std::vector<double>>(huge + "12345678"), DamagedBytes);
  EXPECT_THROW((void)valueOf<std::vector<Part>>(huge + "12345678"), DamagedBytes);
  EXPECT_THROW((void)valueOf<std::string>(huge), DamagedBytes);
}

}  // namespace
}  // namespace gnomon::cache

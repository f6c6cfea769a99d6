// Any bytes as an entry of the cache: as its file, which must be the very one that was written, and
// as its content, as if the checksum were right. The first byte chooses what it is taken for.

#include <array>

#include "cache/byte_stream.h"
#include "cache/cache_folder.h"
#include "fuzz/reader_fuzz.h"
#include "study/run/scene/cached_fields.h"

namespace {

using namespace gnomon;

/// Bytes that are taken are exactly those of the value that they give.
template <typename Value>
void take(std::string_view bytes) {
  try {
    if (cache::bytesOf(cache::valueOf<Value>(bytes)) != bytes) std::abort();
  } catch (const cache::DamagedBytes&) {
  }
}

constexpr std::array takers = {take<Mask>,
                               take<render::MethodAnswers>,
                               take<truth::Truth>,
                               take<surface::SampleGrid>,
                               take<compare::SampleLayout>,
                               take<render::RenderView>,
                               take<horizon::HorizonTables>,
                               take<horizon::EllipseTable>,
                               take<horizon::AngleTable>,
                               take<compare::BlockErrors>,
                               take<study::AnswerOutcome>,
                               take<compare::ShadowLengths>,
                               take<study::LayersRecord>,
                               take<std::optional<study::UncertaintyRecord>>,
                               take<study::MethodOutcome>,
                               take<std::string>,
                               take<std::optional<bool>>,
                               take<Visibility>,
                               take<render::VisibilityAnswers>};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  takers.at(data[0] % takers.size())(bytes);
  const cache::ContentKey key = cache::KeyBuilder("fuzz").key();
  const auto content = cache::openedEntry(key, bytes);
  if (content && cache::sealedEntry(key, *content) != bytes) std::abort();
  const std::string sealed = cache::sealedEntry(key, bytes);
  if (cache::openedEntry(key, sealed) != bytes) std::abort();
  return 0;
}

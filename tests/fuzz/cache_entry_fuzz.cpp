// Any bytes as an entry of the cache: as its file, which must be the very one that was written, and
// as its content, as if the checksum were right. The first byte chooses what it is taken for.

#include <array>

#include "cache/byte_stream.h"
#include "cache/entry.h"
#include "fuzz/reader_fuzz.h"
#include "study/run/scene/cached_fields.h"

namespace {

using namespace gnomon;

/// Bytes that are taken are exactly those of the value that they give.
template <typename Value>
void take(std::string_view bytes) {
  try {
    if (bytesOf(valueOf<Value>(bytes)) != bytes) std::abort();
  } catch (const DamagedBytes&) {
  }
}

constexpr std::array takers = {take<Mask>,
                               take<MethodAnswers>,
                               take<Truth>,
                               take<SampleGrid>,
                               take<SampleLayout>,
                               take<RenderView>,
                               take<HorizonTables>,
                               take<EllipseTable>,
                               take<AngleTable>,
                               take<BlockErrors>,
                               take<BoundaryMetrics>,
                               take<ShadowLengths>,
                               take<LayersRecord>,
                               take<std::optional<RefinementRecord>>,
                               take<MethodOutcome>,
                               take<std::string>,
                               take<std::optional<bool>>};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  takers.at(data[0] % takers.size())(bytes);
  const ContentKey key = KeyBuilder("fuzz").key();
  const auto content = openedEntry(key, bytes);
  if (content && sealedEntry(key, *content) != bytes) std::abort();
  const std::string sealed = sealedEntry(key, bytes);
  if (openedEntry(key, sealed) != bytes) std::abort();
  return 0;
}

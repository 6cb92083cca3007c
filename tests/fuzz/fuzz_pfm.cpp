#include <cstdint>
#include <cstdlib>

#include "support/files/pfm.h"

using namespace obscura;

// What is read can be written, and read again as the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  support::Image image, again;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (!support::decode_pfm(bytes, "fuzz", &image).ok()) return 0;
  std::string written;
  if (!support::encode_pfm(image, &written).ok()) std::abort();
  if (!support::decode_pfm(written, "fuzz", &again).ok()) std::abort();
  if (again.width != image.width || again.channels.size() != image.channels.size()) std::abort();
  return 0;
}

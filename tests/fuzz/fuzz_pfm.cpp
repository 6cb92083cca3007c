#include <cstdint>
#include <cstdlib>

#include "io/images/pfm.h"

using namespace obscura;

// What is read can be written, and read again as the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tools::Image image, again;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (!tools::decode_pfm(bytes, "fuzz", &image).ok()) return 0;
  std::string written;
  if (!tools::encode_pfm(image, &written).ok()) std::abort();
  if (!tools::decode_pfm(written, "fuzz", &again).ok()) std::abort();
  if (again.width != image.width || again.channels.size() != image.channels.size()) std::abort();
  return 0;
}

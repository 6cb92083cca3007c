#include <cstdint>
#include <cstdlib>

#include "io/images/png.h"

using namespace obscura;

// What is read can be written, and read again as the same values.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tools::Image image, again;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (!tools::decode_png(bytes, "fuzz", &image).ok()) return 0;
  std::string written;
  if (!tools::encode_png(image, 16, &written).ok()) std::abort();
  if (!tools::decode_png(written, "fuzz", &again).ok()) std::abort();
  if (again.channels[0].values != image.channels[0].values) std::abort();
  return 0;
}

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "io/images/hdr.h"

// Every radiance that is read is finite and not negative.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  obscura::tools::Image image;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (!obscura::tools::decode_hdr(bytes, "fuzz", &image).ok()) return 0;
  for (const auto& channel : image.channels) {
    if (channel.values.size() != static_cast<std::size_t>(image.width) * image.height) std::abort();
    for (float v : channel.values) {
      if (!(v >= 0 && std::isfinite(v))) std::abort();
    }
  }
  return 0;
}

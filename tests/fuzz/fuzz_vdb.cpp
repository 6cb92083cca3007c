#include <cstdint>
#include <cstdlib>
#include <string>

#include "io/volumes/vdb_native.h"

using namespace obscura;

// What obscura-vdb hands over, of which a damaged file may have made anything: a failure has a
// reason, and a volume that is taken comes back the same when it is handed over again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  tools::VolumeImage image, again;
  const Status s = tools::parse_vdb_header("fuzz.vdb", text, &image);
  if (!s.ok()) {
    if (s.message().empty() || s.code() > StatusCode::kInternal) std::abort();
    return 0;
  }
  if (!tools::check_geometry(image).ok()) return 0;
  const std::string written = tools::write_vdb_header(s, image);
  if (!tools::parse_vdb_header("fuzz.vdb", written.substr(0, written.size() - 1), &again).ok()) {
    std::abort();
  }
  if (again.size != image.size || again.isovalue != image.isovalue) std::abort();
  return 0;
}

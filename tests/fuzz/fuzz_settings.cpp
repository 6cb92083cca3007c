#include <cstdint>
#include <cstdlib>

#include "io/sequences/frame_names.h"
#include "obscura/methods.h"

using namespace obscura;

// Text for every field of every method, and of frames: what is taken can be written, and read again
// as the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const std::string_view method : method_names()) {
    MethodSettings settings;
    if (!make_settings(method, &settings).ok()) std::abort();
    for_each_field(settings, [&](auto& value, const Field& field) {
      auto given = value, again = value;
      if (!parse_setting("x", field, text, &given).ok()) return;
      const std::string written = write_setting(given);
      if (!parse_setting("x", field, written, &again).ok()) std::abort();
      if (write_setting(again) != written) std::abort();
    });
  }
  std::vector<int> frames;
  tools::Shard shard;
  if (tools::parse_shard(text, &shard).ok() && !(shard.index >= 1 && shard.index <= shard.count)) {
    std::abort();
  }
  if (tools::parse_frames(text, &frames).ok() && (frames.empty() || frames.size() > 1000000)) {
    std::abort();
  }
  tools::name_of_frame(text.substr(0, 64), 7);
  return 0;
}

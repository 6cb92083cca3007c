#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "obscura/volume.h"
#include "tests/fuzz/bytes.h"

using namespace obscura;

// Any volume and settings: refused, or distances that are numbers with the sign of their side, and
// visibility in [0, 1].
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  VolumeView volume;
  volume.size = {1 + bytes.below(10), 1 + bytes.below(10), 1 + bytes.below(10)};
  for (float& h : volume.spacing) h = bytes.flag() ? bytes.number() : 1;
  DistanceSettings settings;
  settings.isovalue = bytes.number();
  settings.solid = static_cast<SolidSide>(bytes.below(2));
  settings.start = static_cast<DistanceStart>(bytes.below(2));
  settings.converge = bytes.flag();
  OcclusionSettings occlusion;
  occlusion.transport = static_cast<Transport>(bytes.below(kEnumCount<Transport>));
  if (bytes.flag()) occlusion.alpha = bytes.number();
  const std::array<float, 3> light{bytes.number(), bytes.number(), bytes.number()};
  const bool shadow = bytes.flag();
  std::vector<float> samples(static_cast<std::size_t>(volume.size[0] * volume.size[1]) *
                             static_cast<std::size_t>(volume.size[2]));
  for (float& v : samples) v = bytes.number();
  volume.data = samples.data();
  std::vector<float> distance(samples.size(), -3);
  const RunOptions run{.threads = 1};
  const Status swept =
      sweep_distance(volume, settings, {distance.data(), volume.size, volume.spacing}, run);
  if (!swept.ok()) {
    if (swept.message().empty()) std::abort();
    for (float v : distance) {
      if (v != -3) std::abort();
    }
    return 0;
  }
  for (float v : distance) {
    if (std::isnan(v)) std::abort();
  }
  const GridView<const float> grid(distance.data(), volume.size, volume.spacing);
  VisibilityField field;
  if (shadow) {
    (void)sweep_shadow(grid, light, occlusion, &field, run);
    return 0;
  }
  if (!sweep_occlusion(grid, occlusion, &field, run).ok()) return 0;
  std::vector<float> visibility(samples.size());
  if (!field.scalar({visibility.data(), volume.size, volume.spacing}, run).ok()) return 0;
  for (float v : visibility) {
    if (!(v >= 0 && v <= 1.0001f)) std::abort();
  }
  return 0;
}

// docs/methods/occlusion-sweeping.md: matter in the lower half of a volume.
#include <span>
#include <vector>

#include "snippets.h"
#include "sweeping_includes.inc"

bool run_sweeping() {
  const int side = 16, n = side * side * side;
  std::vector<float> values(n, 0.0f);
  for (int i = 0; i < n / 2; ++i) values[i] = 180;  // z is slowest
  const obscura::VolumeView volume{.data = values.data(), .size = {side, side, side}};
  const std::vector<obscura::SurfacePoint> points{{{7, 7, 7.5f}, {0, 0, 1}}};
  std::vector<float> visibility(points.size());
#include "sweeping.inc"
  return visibility[0] > 0.95f;  // a plane is open
}

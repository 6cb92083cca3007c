#include <algorithm>
#include <vector>

#include "volume/occlusion_kernel.h"

namespace obscura {

void sweep_occlusion_f32(const float* tau, const std::array<int, 3>& size,
                         const std::array<bool, 3>& from_positive, const SweepDirection& direction,
                         float* visibility, std::ptrdiff_t step) {
  const int nx = size[0], ny = size[1], nz = size[2];
  // W = V tau of the plane before and of this one, with a border of open voxels upwind.
  const std::ptrdiff_t pitch = nx + 1;
  const std::size_t plane = static_cast<std::size_t>(pitch) * (ny + 1);
  std::vector<float> before(plane, 1.0f), now(plane, 1.0f);
  const float f = direction.first, g = direction.second;
  auto between = [](float a, float b, float share) { return a + (b - a) * share; };
  for (int k = 0; k < nz; ++k) {
    const int z = from_positive[2] ? nz - 1 - k : k;
    for (int j = 0; j < ny; ++j) {
      const int y = from_positive[1] ? ny - 1 - j : j;
      for (int i = 0; i < nx; ++i) {
        const int x = from_positive[0] ? nx - 1 - i : i;
        const float* c = now.data() + (j + 1) * pitch + i + 1;
        const float* b = before.data() + (j + 1) * pitch + i + 1;
        float v;
        if (direction.stencil == Stencil::kUpwind) {
          v = b[0] + (c[-1] - b[0]) * f + (c[-pitch] - b[0]) * g;
        } else if (direction.axis == 0) {
          v = between(between(c[-1], c[-1 - pitch], f), between(b[-1], b[-1 - pitch], f), g);
        } else if (direction.axis == 1) {
          v = between(between(c[-pitch], c[-1 - pitch], f), between(b[-pitch], b[-1 - pitch], f),
                      g);
        } else {
          v = between(between(b[0], b[-1], f), between(b[-pitch], b[-1 - pitch], f), g);
        }
        const std::ptrdiff_t voxel =
            x + static_cast<std::ptrdiff_t>(nx) * (y + static_cast<std::ptrdiff_t>(ny) * z);
        visibility[voxel * step] = v;
        now[static_cast<std::size_t>((j + 1) * pitch + i + 1)] = v * tau[voxel];
      }
    }
    now.swap(before);
  }
}

}  // namespace obscura

// README.md: a wall with a box before it.
#include <vector>

#include "readme_includes.inc"
#include "snippets.h"

bool run_readme() {
  const int width = 64, height = 36;
  const float fov_y = 0.9f;
  std::vector<float> depth(width * height, 4.0f), visibility(width * height);
  for (int y = 12; y < 24; ++y) {
    for (int x = 24; x < 40; ++x) depth[y * width + x] = 3.5f;
  }
#include "readme.inc"
  return status.ok() && visibility[18 * width + 23] < visibility[0];
}

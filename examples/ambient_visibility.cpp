// The shortest way in: arrays in, arrays out.
#include <obscura/obscura.h>

#include <cstdio>
#include <vector>

int main() {
  const int width = 320, height = 180;
  std::vector<float> depth(width * height, 4.0f), visibility(width * height);
  for (int y = 60; y < 120; ++y) {
    for (int x = 120; x < 200; ++x) depth[y * width + x] = 3.5f;  // a box before a wall
  }
  obscura::DepthField field{.depth = {depth.data(), width, height},
                            .camera = obscura::Camera::perspective(0.9f, width, height)};
  obscura::FarFieldSettings settings;
  settings.falloff.radius = 0.5f;
  const obscura::Status status =
      obscura::compute(field, settings, {.visibility = {visibility.data(), width, height}});
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  std::printf("wall, far from the box: %.2f; wall, at its edge: %.2f\n", visibility[0],
              visibility[90 * width + 118]);
}

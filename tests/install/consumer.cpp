#include <obscura/obscura.h>

#include <cstdio>
#include <vector>

#if OBSCURA_VERSION < OBSCURA_MAKE_VERSION(0, 1, 0)
#error "these headers are older than this consumer"
#endif

int main() {
  std::vector<float> depth(64 * 48, 3.0f), visibility(64 * 48);
  obscura::DepthField field{.depth = {depth.data(), 64, 48}};
  field.camera = obscura::Camera::perspective(0.8f, 64, 48);
  const obscura::Status status =
      obscura::compute(field, obscura::LineSettings{}, {.visibility = {visibility.data(), 64, 48}});
  std::printf("%s %.3f\n", status.message().c_str(), visibility[0]);
  return status.ok() && visibility[0] > 0.99f ? 0 : 1;
}

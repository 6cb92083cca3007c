#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "io/images/depth_camera.h"
#include "io/sequences/camera_list.h"
#include "tests/fuzz/memory_file.h"

using namespace obscura;

// Matrices as JSON and as text: what is read is finite.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const fuzz::MemoryFile file(data, size, ".txt");
  auto check = [](const auto& numbers) {
    for (double v : numbers) {
      if (!std::isfinite(v)) std::abort();
    }
  };
  std::vector<tools::ProjectionMatrix> cameras;
  if (tools::read_cameras(file.path(), {1, 2}, &cameras).ok()) {
    if (cameras.size() != 2) std::abort();
    for (const auto& camera : cameras) check(camera);
  }
  std::array<double, 16> matrix{};
  if (tools::read_matrix(file.path(), "projection", matrix.data()).ok()) check(matrix);
  return 0;
}

#include "screen/volumetric/line/plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "obscura/estimator.h"
#include "tests/reference/volumetric.h"
#include "tests/unit/screen/volumetric/volumetric_cases.h"

namespace obscura {
namespace {

using namespace volumetric_cases;

// Largest difference between a kernel and the double-precision evaluation where both fetch the same
// texels: float rounding of depths, about 1e-7 of the depth over a radius of a tenth of it, and
// Highway's logarithm.
constexpr double kKernelTolerance = 2e-5;

TEST(Line, EveryTargetAgreesWithScalar) {
  for (const Case& c : all_cases()) {
    const view::Geometry g = geometry(c);
    const auto s = settings_of<LineSettings>(c);
    std::unique_ptr<Method> method;
    ASSERT_TRUE(make_method(s, g.width, g.height, &method).ok());
    const reference::Line reference(g, s, disk_pattern(s.samples, false));
    // A tap on the border between two texels may fall to either side.
    expect_agreement(g, method.get(), reference, 1, kKernelTolerance, 3, c);
  }
}

std::vector<float> run(const DepthField& field, const LineSettings& s,
                       std::span<const DiskSample> pattern) {
  std::unique_ptr<Executor> executor = make_executor(1);
  view::Geometry g;
  EXPECT_TRUE(
      view::convert(field, {.normals = true, .works_without_normals = true}, *executor, &g).ok());
  LineFrame f = line_frame(s, pattern);
  f.view = view::make_tap_frame(g, f.view.radius);
  const Extent visible = g.visible();
  std::vector<float> result(static_cast<std::size_t>(visible.width) * visible.height);
  for (int y = 0; y < visible.height; ++y) {
    line_row(f, y, 0, visible.width, &result[static_cast<std::size_t>(y) * visible.width]);
  }
  return result;
}

// Taps are rounded to texels in a way that knows no left and right: a mirrored image and a mirrored
// pattern give the mirrored result, bit for bit where sums keep their order.
TEST(Line, MirroredInputGivesMirroredOutput) {
  const int width = 64, height = 40;
  const std::vector<float> depth = bumpy_depth(width, height);
  std::vector<float> mirrored(depth.size());
  for (int i = 0; i < width * height; ++i)
    mirrored[i] = depth[i / width * width + width - 1 - i % width];
  LineSettings s;
  s.falloff.radius = 0.5f;
  s.rotate = false;
  const std::span<const DiskSample> pattern = disk_pattern(9, false);
  Camera camera = Camera::perspective(0.8f, width, height);
  for (const bool normals : {false, true}) {
    DepthField field = field_of(depth, width, height, camera);
    field.normal_use = normals ? NormalUse::kAuto : NormalUse::kNone;
    const std::vector<float> a = run(field, s, pattern);
    std::vector<DiskSample> other(pattern.begin(), pattern.end());
    for (DiskSample& p : other) p.x = -p.x;
    field.depth.data = mirrored.data();
    const std::vector<float> b = run(field, s, other);
    int different = 0;
    for (int i = 0; i < width * height; ++i) {
      different += std::abs(a[i] - b[i / width * width + width - 1 - i % width]) > 1e-5f;
    }
    // Reconstructed normals prefer the forward difference where both sides change alike.
    EXPECT_LE(different, normals ? 40 : 0);
  }
}

// 17 million texels: their numbers are not exact in a float.
TEST(Line, LargeImagesAreIndexedExactly) {
  const int width = 65535, height = 262;
  view::Geometry g;
  g.width = width;
  g.height = height;
  g.camera = Camera::perspective(0.02f, width, height);
  g.depth.resize(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) g.depth(x, y) = 5 + 0.01f * ((x * 7 + y * 3) % 32);
  }
  LineSettings s;
  s.blur = false;
  s.falloff.radius = 0.5f * g.camera.scale_x * 5 * height;
  g.guard_band = {width - 40, 1, height - 30, 1};  // the far corner; then the near one
  std::unique_ptr<Executor> executor = make_executor(1);
  for (int corner = 0; corner < 2; ++corner) {
    std::unique_ptr<Method> method;
    ASSERT_TRUE(make_method(s, g.width, g.height, &method).ok());
    const int w = g.visible().width, h = g.visible().height;
    std::vector<float> result(static_cast<std::size_t>(w) * h);
    ASSERT_TRUE(method->run(g, {.visibility = {result.data(), w, h}}, {*executor, {}}).ok());
    const reference::Line reference(g, s, disk_pattern(s.samples, false));
    int different = 0;
    for (int i = 0; i < w * h; ++i) {
      different += std::abs(result[i] - reference.visibility(i % w, i / w)) > 1e-4;
    }
    EXPECT_LE(different, w * h / 100);
    g.guard_band = {1, width - 40, 1, height - 30};
  }
}

}  // namespace
}  // namespace obscura

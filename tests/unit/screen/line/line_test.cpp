#include "screen/line/line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "hwy/targets.h"
#include "obscura/estimator.h"
#include "tests/reference/volumetric.h"

namespace obscura {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

// Largest difference between a kernel and the double-precision evaluation where both fetch the same
// texels: float rounding of depths, about 1e-7 of the depth over a radius of a tenth of it, and
// Highway's logarithm.
constexpr double kKernelTolerance = 2e-5;

// Waves, a box in front, a hole to the background.
std::vector<float> bumpy_depth(int width, int height) {
  std::vector<float> depth(static_cast<std::size_t>(width) * height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      float z = 4 + 0.03f * y + 0.2f * std::sin(0.31f * x) * std::cos(0.23f * y);
      if (x > width / 3 && x < width / 2 && y > height / 4) z = 3;
      if (x > 2 * width / 3 && y < height / 4) z = kInf;
      depth[static_cast<std::size_t>(y) * width + x] = z;
    }
  }
  return depth;
}

DepthField field_of(const std::vector<float>& depth, int width, int height, const Camera& camera) {
  DepthField f;
  f.depth = {depth.data(), width, height};
  f.camera = camera;
  return f;
}

struct Case {
  bool normals, rotate, thickness, quadratic, orthographic;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (int i = 0; i < 32; ++i) {
    cases.push_back({(i & 1) != 0, (i & 2) != 0, (i & 4) != 0, (i & 8) != 0, (i & 16) != 0});
  }
  return cases;
}

// Each SIMD target against the scalar evaluation, with an off-centre camera, oblong pixels, a guard
// band and a width that is no multiple of a vector.
TEST(Line, EveryTargetAgreesWithScalar) {
  const int width = 59, height = 43;
  const std::vector<float> depth = bumpy_depth(width, height);
  std::unique_ptr<Executor> executor = make_executor(1);
  for (const Case& c : all_cases()) {
    Camera camera;
    camera.orthographic = c.orthographic;
    camera.scale_x = c.orthographic ? 0.05f : 0.011f;
    camera.scale_y = c.orthographic ? 0.04f : 0.013f;
    camera.center_u = 20;
    camera.center_v = 37;
    DepthField field = field_of(depth, width, height, camera);
    field.guard_band = {7, 5, 3, 9};
    field.normal_use = c.normals ? NormalUse::kAuto : NormalUse::kNone;
    LineSettings s;
    s.falloff.kind = c.quadratic ? FalloffKind::kQuadratic : FalloffKind::kConstant;
    s.falloff.radius = 0.6f;
    s.rotate = c.rotate;
    if (c.thickness) s.occluder = Occluder::of_thickness(0.3f);

    view::Geometry g;
    ASSERT_TRUE(
        view::convert(field, {.normals = true, .works_without_normals = true}, *executor, &g).ok());
    const reference::Line reference(g, s, disk_pattern(s.samples, false));
    std::vector<double> expected;
    double sum = 0;
    for (int y = 0; y < g.visible_height(); ++y) {
      for (int x = 0; x < g.visible_width(); ++x) {
        expected.push_back(reference.visibility(x, y));
        sum += expected.back();
      }
    }
    EXPECT_LT(sum, 0.99 * expected.size());  // something is occluded

    std::unique_ptr<Method> method;
    ASSERT_TRUE(make_line(s, &method).ok());
    std::vector<float> result(expected.size());
    const Outputs outputs{.visibility = {result.data(), g.visible_width(), g.visible_height()}};
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      ASSERT_TRUE(method->run(g, outputs, {*executor, {}}).ok());
      int different = 0;
      for (std::size_t i = 0; i < result.size(); ++i) {
        different += !(std::abs(result[i] - expected[i]) <= kKernelTolerance);
      }
      // A tap on the border between two texels may fall to either side.
      EXPECT_LE(different, 3) << hwy::TargetName(target) << " normals " << c.normals << " rotate "
                              << c.rotate << " thickness " << c.thickness << " quadratic "
                              << c.quadratic << " orthographic " << c.orthographic;
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

std::vector<float> run(const DepthField& field, const LineSettings& s,
                       std::span<const DiskSample> pattern) {
  std::unique_ptr<Executor> executor = make_executor(1);
  view::Geometry g;
  EXPECT_TRUE(
      view::convert(field, {.normals = true, .works_without_normals = true}, *executor, &g).ok());
  std::unique_ptr<Method> method;
  EXPECT_TRUE(make_line_with(s, pattern, &method).ok());
  std::vector<float> result(static_cast<std::size_t>(g.visible_width()) * g.visible_height());
  const Outputs outputs{.visibility = {result.data(), g.visible_width(), g.visible_height()}};
  EXPECT_TRUE(method->run(g, outputs, {*executor, {}}).ok());
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
  s.falloff.radius = 0.5f * g.camera.scale_x * 5 * height;
  g.guard_band = {width - 40, 1, height - 30, 1};  // the far corner; then the near one
  std::unique_ptr<Executor> executor = make_executor(1);
  for (int corner = 0; corner < 2; ++corner) {
    std::unique_ptr<Method> method;
    ASSERT_TRUE(make_line(s, &method).ok());
    const int w = g.visible_width(), h = g.visible_height();
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

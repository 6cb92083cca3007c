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
    ASSERT_TRUE(view::convert(field, {.normals = true}, *executor, &g).ok());
    const reference::Line reference(g, s, disk_pattern(s.samples));
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

}  // namespace
}  // namespace obscura

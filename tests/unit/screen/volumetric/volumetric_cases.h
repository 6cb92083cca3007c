#ifndef OBSCURA_TESTS_UNIT_SCREEN_VOLUMETRIC_VOLUMETRIC_CASES_H_
#define OBSCURA_TESTS_UNIT_SCREEN_VOLUMETRIC_VOLUMETRIC_CASES_H_

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>
#include <vector>

#include "hwy/targets.h"
#include "obscura/executor.h"
#include "screen/method.h"
#include "view/geometry.h"

// The depth image and the modes in which point, line and area kernels are held against their scalar
// evaluations in tests/reference.
namespace obscura::volumetric_cases {

// Waves, a box in front, a hole to the background.
inline std::vector<float> bumpy_depth(int width, int height) {
  std::vector<float> depth(static_cast<std::size_t>(width) * height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      float z = 4 + 0.03f * y + 0.2f * std::sin(0.31f * x) * std::cos(0.23f * y);
      if (x > width / 3 && x < width / 2 && y > height / 4) z = 3;
      if (x > 2 * width / 3 && y < height / 4) z = std::numeric_limits<float>::infinity();
      depth[static_cast<std::size_t>(y) * width + x] = z;
    }
  }
  return depth;
}

inline DepthField field_of(const std::vector<float>& depth, int width, int height,
                           const Camera& camera) {
  DepthField f;
  f.depth = {depth.data(), width, height};
  f.camera = camera;
  return f;
}

struct Case {
  bool normals, rotate, thickness, quadratic, orthographic;
};

inline std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << "normals " << c.normals << " rotate " << c.rotate << " thickness " << c.thickness
             << " quadratic " << c.quadratic << " orthographic " << c.orthographic;
}

inline std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (int i = 0; i < 32; ++i) {
    cases.push_back({(i & 1) != 0, (i & 2) != 0, (i & 4) != 0, (i & 8) != 0, (i & 16) != 0});
  }
  return cases;
}

inline constexpr int kWidth = 59, kHeight = 43;

// An off-centre camera, oblong pixels, a guard band and a width that is no multiple of a vector.
inline view::Geometry geometry(const Case& c, int width = kWidth, int height = kHeight) {
  const std::vector<float> depth = bumpy_depth(width, height);
  Camera camera;
  camera.orthographic = c.orthographic;
  camera.scale_x = c.orthographic ? 0.05f : 0.011f;
  camera.scale_y = c.orthographic ? 0.04f : 0.013f;
  camera.center_u = 20;
  camera.center_v = 37;
  DepthField field = field_of(depth, width, height, camera);
  field.guard_band = {7, 5, 3, 9};
  field.normal_use = c.normals ? NormalUse::kAuto : NormalUse::kNone;
  view::Geometry g;
  EXPECT_TRUE(
      view::convert(field, {.normals = true, .works_without_normals = true}, *make_executor(1), &g)
          .ok());
  return g;
}

template <class Settings>
Settings settings_of(const Case& c) {
  Settings s;
  s.falloff.kind = c.quadratic ? FalloffKind::kQuadratic : FalloffKind::kConstant;
  s.falloff.radius = 0.6f;
  s.rotate = c.rotate;
  s.blur = false;
  if (c.thickness) s.occluder = Occluder::of_thickness(0.3f);
  return s;
}

// No template: clang 14 forgets the destructor of a temporary std::function in one.
inline Status run_on(Executor& executor, const view::Geometry& g, ImageView<float> out,
                     Method* method) {
  return method->run(g, {.visibility = out}, {executor, {}});
}

// Each SIMD target's result against the scalar evaluation, wherever neither x nor y leaves a rest
// when divided by `every`; at most `allowed` of these pixels may be off by more than `tolerance`.
template <class Reference>
void expect_agreement(const view::Geometry& g, Method* method, const Reference& reference,
                      int every, double tolerance, int allowed, const Case& c) {
  const std::unique_ptr<Executor> executor = make_executor(1);
  const int width = g.visible().width, height = g.visible().height;
  std::vector<double> expected;
  double sum = 0;
  for (int y = 0; y < height; y += every) {
    for (int x = 0; x < width; x += every) sum += expected.emplace_back(reference.visibility(x, y));
  }
  EXPECT_LT(sum, 0.99 * expected.size());  // something is occluded
  std::vector<float> result(static_cast<std::size_t>(width) * height);
  const ImageView<float> out(result.data(), width, height);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_TRUE(run_on(*executor, g, out, method).ok());
    int different = 0;
    std::size_t i = 0;
    for (int y = 0; y < height; y += every) {
      for (int x = 0; x < width; x += every) {
        different += !(std::abs(out(x, y) - expected[i++]) <= tolerance);
      }
    }
    EXPECT_LE(different, allowed) << hwy::TargetName(target) << " " << c;
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace obscura::volumetric_cases

#endif  // OBSCURA_TESTS_UNIT_SCREEN_VOLUMETRIC_VOLUMETRIC_CASES_H_

#include "filters/bilateral/bilateral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hwy/targets.h"

namespace obscura {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

view::Geometry geometry_of(int width, int height, float (*depth)(int, int), GuardBand guard = {}) {
  view::Geometry g;
  g.width = width;
  g.height = height;
  g.guard_band = guard;
  g.camera = Camera::perspective(1.0f, width, height);
  g.depth.resize(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) g.depth(x, y) = depth(x, y);
  }
  return g;
}

std::vector<float> blur(const view::Geometry& g, float (*value)(int, int), float edge) {
  const int width = g.visible().width, height = g.visible().height;
  BilateralFilter filter;
  filter.resize(g.width, g.height);
  filter.set_size(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) filter.input()(x, y) = value(x, y);
  }
  std::vector<float> result(static_cast<std::size_t>(width) * height);
  filter.run(g, edge, *make_executor(2), {result.data(), width, height});
  return result;
}

float checker(int x, int y) { return static_cast<float>((x + y) & 1); }

// 1/depth linear in x and y: a plane, tilted until its far end is ten times the near end's depth.
float steep_plane(int x, int y) { return 1 / (0.1f + 0.015f * x + 0.004f * y); }

TEST(Bilateral, ConstantStaysExactly) {
  const view::Geometry g = geometry_of(
      53, 31, [](int x, int y) { return x * y % 7 == 3 ? kInf : 3 + std::sin(x * 0.7f + y); });
  for (const float v : blur(
           g, [](int, int) { return 0.3f; }, 0.5f))
    EXPECT_EQ(v, 0.3f);
}

// On a plane all taps count in full, whatever the tilt: the binomial weights' answer to a checker
// board is 2^-16 in the interior.
TEST(Bilateral, PlanesAreBlurredInFull) {
  const view::Geometry g = geometry_of(60, 40, steep_plane);
  const std::vector<float> v = blur(g, checker, 0.3f);
  for (int y = 4; y < 36; ++y) {
    for (int x = 4; x < 56; ++x) EXPECT_NEAR(v[y * 60 + x], 0.5f, 1e-3f) << x << ", " << y;
  }
}

TEST(Bilateral, EdgesAreKept) {
  const view::Geometry g = geometry_of(40, 20, [](int x, int) { return x < 20 ? 2.0f : 4.0f; });
  const std::vector<float> v = blur(
      g, [](int x, int) { return x < 20 ? 0.25f : 0.75f; }, 1.0f);
  for (int i = 0; i < 800; ++i) EXPECT_EQ(v[i], i % 40 < 20 ? 0.25f : 0.75f);
}

TEST(Bilateral, BackgroundNeitherGivesNorTakes) {
  const view::Geometry g = geometry_of(40, 20, [](int x, int) { return x < 20 ? 2.0f : kInf; });
  const std::vector<float> v = blur(
      g, [](int x, int) { return x < 20 ? 0.25f : 1.0f; }, 1e30f);
  for (int i = 0; i < 800; ++i) EXPECT_EQ(v[i], i % 40 < 20 ? 0.25f : 1.0f);
}

TEST(Bilateral, StaysWithinItsInputsRangeAndFinite) {
  for (const auto& [w, h] : {std::pair{1, 1}, {1, 30}, {30, 1}, {16, 16}, {17, 9}}) {
    const view::Geometry g = geometry_of(w, h, [](int x, int y) {
      return (x * 7 + y * 13) % 5 == 0 ? kInf : (x % 3 ? 1e-30f : 1e30f);
    });
    for (const float edge : {1e-30f, 1.0f, 1e30f}) {
      for (const float v : blur(g, checker, edge)) {
        EXPECT_TRUE(v >= 0 && v <= 1) << w << "x" << h << ", edge " << edge << ": " << v;
      }
    }
  }
}

// The guard band only shifts which depths belong to the pixels.
TEST(Bilateral, GuardBandIsSkipped) {
  const view::Geometry whole = geometry_of(30, 20, steep_plane);
  const view::Geometry banded =
      geometry_of(37, 25, [](int x, int y) { return steep_plane(x - 4, y - 2); }, {4, 3, 2, 3});
  EXPECT_EQ(blur(whole, checker, 0.2f), blur(banded, checker, 0.2f));
}

TEST(Bilateral, MirroredInputGivesMirroredOutput) {
  auto bumpy = [](int x, int y) { return 3 + std::sin(x * 0.9f) * std::cos(y * 0.7f); };
  const view::Geometry g = geometry_of(41, 23, bumpy);
  const view::Geometry m = geometry_of(
      41, 23, [](int x, int y) { return 3 + std::sin((40 - x) * 0.9f) * std::cos(y * 0.7f); });
  auto value = [](int x, int y) { return static_cast<float>((x * 5 + y * 3) % 11); };
  auto mirrored = [](int x, int y) { return static_cast<float>(((40 - x) * 5 + y * 3) % 11); };
  const std::vector<float> a = blur(g, value, 0.5f), b = blur(m, mirrored, 0.5f);
  for (int i = 0; i < 41 * 23; ++i) EXPECT_NEAR(a[i], b[i / 41 * 41 + 40 - i % 41], 1e-5f);
}

TEST(Bilateral, EveryTargetAgrees) {
  const view::Geometry g =
      geometry_of(61, 37, [](int x, int y) { return 3 + std::sin(x * 0.4f) * std::cos(y * 0.3f); });
  std::vector<float> first;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    const std::vector<float> v = blur(g, checker, 0.3f);
    if (first.empty()) first = v;
    for (std::size_t i = 0; i < v.size(); ++i) EXPECT_NEAR(v[i], first[i], 2e-6f);
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace obscura

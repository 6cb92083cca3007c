// Directions from the far field, and the ways to share its work among pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "obscura/obscura.h"
#include "tests/property/synthetic.h"

namespace obscura {
namespace {

constexpr float kHalfPi = 1.57079633f;

// All outputs of one run.
struct Result {
  int width, height;
  std::vector<float> planes[14];

  ImageView<float> view(int i) { return {planes[i].data(), width, height}; }
  VectorView<float> vector(int i) { return {view(i), view(i + 1), view(i + 2)}; }
  enum {
    kVisibility,
    kCone,
    kBent,
    kUniform = kBent + 3,
    kCosine = kUniform + 3,
    kNormal = kCosine + 3
  };

  Outputs outputs() {
    return {.visibility = view(kVisibility),
            .bent_normal = vector(kBent),
            .cone_angle = view(kCone),
            .uniform_integral = vector(kUniform),
            .cosine_integral = vector(kCosine),
            .normal = vector(kNormal)};
  }
  double dot(int a, int b, std::size_t i) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += double(planes[a + k][i]) * planes[b + k][i];
    return sum;
  }
};

Result run(const DepthField& field, const MethodSettings& settings) {
  Result r{field.visible().width, field.visible().height, {}};
  for (auto& p : r.planes) p.assign(static_cast<std::size_t>(r.width) * r.height, -9.0f);
  const Status s = compute(field, settings, r.outputs());
  EXPECT_TRUE(s.ok()) << s.message();
  return r;
}

std::vector<float> visibility(const DepthField& field, const FarFieldSettings& settings) {
  std::vector<float> v(static_cast<std::size_t>(field.visible().width) * field.visible().height);
  const Status s = compute(
      field, settings, {.visibility = {v.data(), field.visible().width, field.visible().height}});
  EXPECT_TRUE(s.ok()) << s.message();
  return v;
}

double mean_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / a.size();
}

synthetic::Input scene(bool orthographic = false) {
  return synthetic::blocks(
      120, 80,
      orthographic ? Camera::orthographic_height(4, 120, 80) : Camera::perspective(1, 120, 80), 3);
}

FarFieldSettings settings_of(float radius, const Occluder& occluder = {}) {
  FarFieldSettings s{.occluder = Occluder::solid()};
  s.falloff.radius = radius;
  s.occluder = occluder;
  return s;
}

// The normal times the uniform integral is the visibility: both sum the same pieces.
TEST(FarFieldDirections, UniformIntegralCarriesTheVisibility) {
  for (bool orthographic : {false, true}) {
    const synthetic::Input in = scene(orthographic);
    for (float radius : {0.5f, std::numeric_limits<float>::infinity()}) {
      for (const Occluder& occluder : {Occluder{}, Occluder::of_thickness(0.4f)}) {
        const FarFieldSettings s = settings_of(radius, occluder);
        const Result r = run(in.field(), s);
        EXPECT_LT(mean_difference(visibility(in.field(), s), r.planes[0]), 1e-6);
        double mean = 0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < in.depth.size(); ++i) {
          if (!std::isfinite(in.depth[i])) continue;
          mean += std::abs(r.dot(Result::kNormal, Result::kUniform, i) - r.planes[0][i]);
          ++count;
          EXPECT_NEAR(r.dot(Result::kBent, Result::kBent, i), 1, 1e-4);
          EXPECT_GE(r.planes[Result::kCone][i], 0);
          EXPECT_LE(r.planes[Result::kCone][i], kHalfPi + 1e-4);
        }
        // Finite occluders are counted in sectors; a sector has the mean direction of its piece.
        EXPECT_LT(mean / count, occluder.kind == OccluderKind::kSolid ? 1e-4 : 2e-2);
      }
    }
  }
}

// Where pixels share slices, those of a neighbour belong to its normal: nearly.
TEST(FarFieldDirections, SharedSlicesNearlyCarryTheVisibility) {
  const synthetic::Input in = scene(false);
  FarFieldSettings s = settings_of(0.5f, Occluder::solid());
  s.preset = FarFieldPreset::kFast;
  const Result r = run(in.field(), s);
  double mean = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < in.depth.size(); ++i) {
    if (!std::isfinite(in.depth[i])) continue;
    mean += std::abs(r.dot(Result::kNormal, Result::kUniform, i) - r.planes[0][i]);
    ++count;
  }
  EXPECT_LT(mean / count, 0.006);
}

TEST(FarFieldDirections, OpenPlanesLookAlongTheirNormals) {
  const double tilt = 0.6;
  const synthetic::Input in =
      synthetic::plane(90, 70, Camera::perspective(1, 90, 70), std::sin(tilt) * 0.8,
                       std::sin(tilt) * 0.6, std::cos(tilt), 10);
  const Result r = run(in.field(), settings_of(1));
  for (std::size_t i = 0; i < in.depth.size(); ++i) {
    EXPECT_GT(r.dot(Result::kBent, Result::kNormal, i), 0.9998);
    EXPECT_GT(r.planes[Result::kCone][i], kHalfPi - 0.05);
    EXPECT_NEAR(r.dot(Result::kCosine, Result::kNormal, i), 2.0 / 3, 0.005);
  }
}

TEST(FarFieldDirections, AgreeWithTracedOnes) {
  const synthetic::Input in = scene();
  for (const Occluder& occluder : {Occluder{}, Occluder::of_thickness(0.5f)}) {
    const Result fast = run(in.field(), settings_of(1, occluder));
    ReferenceSettings reference{.occluder = Occluder::solid()};
    reference.falloff.radius = 1;
    reference.occluder = occluder;
    reference.rays = 512;
    const Result truth = run(in.field(), reference);
    double angle = 0, cone = 0, cosine = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < in.depth.size(); ++i) {
      if (!std::isfinite(in.depth[i])) continue;
      double between = 0;
      for (int k = 0; k < 3; ++k) {
        between += double(fast.planes[Result::kBent + k][i]) * truth.planes[Result::kBent + k][i];
      }
      angle += std::acos(std::min(1.0, between));
      cone += std::abs(fast.planes[Result::kCone][i] - truth.planes[Result::kCone][i]);
      for (int k = 0; k < 3; ++k) {
        cosine +=
            std::abs(fast.planes[Result::kCosine + k][i] - truth.planes[Result::kCosine + k][i]) /
            3;
      }
      ++count;
    }
    constexpr double kDegrees = 180 / 3.14159265;
    const bool solid = occluder.kind == OccluderKind::kSolid;
    EXPECT_LT(angle / count * kDegrees, solid ? 4 : 6) << static_cast<int>(occluder.kind);
    EXPECT_LT(cone / count * kDegrees, 4) << static_cast<int>(occluder.kind);
    EXPECT_LT(cosine / count, solid ? 0.01 : 0.02) << static_cast<int>(occluder.kind);
  }
}

// Separable evaluation, jitter and a larger line step change the mean little, and nothing where all
// is open.
TEST(FarFieldSharing, StaysNearTheFullEvaluation) {
  const synthetic::Input in = scene();
  struct Variant {
    const char* name;
    std::function<void(FarFieldSettings&)> change;
    double bound;
  };
  for (const Occluder& occluder : {Occluder{}, Occluder::of_thickness(0.5f)}) {
    FarFieldSettings full = settings_of(1, occluder);
    full.directions = 18;
    const std::vector<float> v = visibility(in.field(), full);
    for (const Variant& variant :
         {Variant{"3x3", [](auto& s) { s.separable = 3; }, 0.02},
          Variant{"2x2", [](auto& s) { s.directions = 16, s.separable = 2; }, 0.02},
          Variant{"jitter", [](auto& s) { s.jitter = true; }, 0.025},
          Variant{"every 2nd line", [](auto& s) { s.line_step = 2; }, 0.01},
          Variant{"every 3rd line", [](auto& s) { s.line_step = 3; }, 0.012},
          Variant{"every 4th line", [](auto& s) { s.line_step = 4; }, 0.015},
          Variant{"both", [](auto& s) { s.separable = 3, s.line_step = 2; }, 0.025}}) {
      FarFieldSettings s = full;
      variant.change(s);
      const std::vector<float> shared = visibility(in.field(), s);
      EXPECT_LT(mean_difference(v, shared), variant.bound)
          << variant.name << " " << static_cast<int>(occluder.kind);
      EXPECT_TRUE(
          std::all_of(shared.begin(), shared.end(), [](float x) { return x >= 0 && x <= 1; }));

      const synthetic::Input wall =
          synthetic::plane(50, 40, Camera::perspective(1, 50, 40), 0, 0, 1, 5);
      const std::vector<float> open = visibility(wall.field(), s);
      EXPECT_GT(*std::min_element(open.begin(), open.end()), 0.999f) << variant.name;
    }
  }
}

TEST(FarFieldSharing, TinyImagesAndWrongSettingsAreAnswered) {
  for (const auto& [w, h] : {std::pair{1, 1}, {2, 1}, {1, 7}, {5, 4}}) {
    const synthetic::Input in = synthetic::blocks(w, h, Camera::perspective(1, w, h), 2);
    for (int side : {2, 3}) {
      for (int step : {1, 2, 3, 4}) {
        FarFieldSettings s = settings_of(1);
        s.directions = side * side;
        s.separable = side;
        s.line_step = step;
        for (float v : visibility(in.field(), s)) EXPECT_TRUE(v >= 0 && v <= 1);
      }
    }
  }
  auto message = [](auto change) {
    FarFieldSettings s{.occluder = Occluder::solid()};
    change(s);
    Estimator e;
    return std::string(Estimator::create(s, 8, 8, &e).message());
  };
  EXPECT_NE(message([](auto& s) { s.separable = 4; }).find("separable"), std::string::npos);
  EXPECT_NE(message([](auto& s) { s.separable = 3; }).find("multiple of 9, such as 18"),
            std::string::npos);
  EXPECT_NE(message([](auto& s) { s.separable = 2, s.directions = 18; }).find("multiple of 4"),
            std::string::npos);
  EXPECT_NE(message([](auto& s) {
              s.preset = FarFieldPreset::kFast, s.jitter = true;
            }).find("jitter and preset fast exclude"),
            std::string::npos);
  EXPECT_NE(
      message([](auto& s) { s.separable = 3, s.directions = 18, s.jitter = true; }).find("exclude"),
      std::string::npos);
  EXPECT_NE(message([](auto& s) { s.line_step = 5; }).find("line_step"), std::string::npos);
}

}  // namespace
}  // namespace obscura

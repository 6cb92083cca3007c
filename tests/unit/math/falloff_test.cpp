// Compiled once per SIMD target, to hold the lanes' rho against the scalar one on each of them.
#include "math/falloff.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/unit/math/falloff_test.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "math/falloff-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

// Evaluates `count` distances, any number, as kernels do.
void EvaluateAll(const math::Rho& rho, const float* distances, int count, float* out) {
  namespace hn = hwy::HWY_NAMESPACE;
  const leaf::D d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  math::with_falloff_kind(rho.kind, [&]<FalloffKind kKind>() HWY_ATTR {
    for (int i = 0; i < count; i += lanes) {
      HWY_ALIGN float buffer[16] = {};
      for (int k = 0; k < lanes && i + k < count; ++k) buffer[k] = distances[i + k];
      hn::Store(EvaluateRho<kKind>(rho, hn::Load(d, buffer)), d, buffer);
      for (int k = 0; k < lanes && i + k < count; ++k) out[i + k] = buffer[k];
    }
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {
namespace {

HWY_EXPORT(EvaluateAll);

constexpr float kInf = std::numeric_limits<float>::infinity();
// Highway's exponential is within 3 ulp; fused and separate products differ by as much.
constexpr float kLaneTolerance = 1e-6f;

math::Rho rho_of(Falloff falloff) {
  math::Rho rho;
  const Status s = math::make_rho(falloff, &rho);
  EXPECT_TRUE(s.ok()) << s.message();
  return rho;
}

math::Rho rho_of(FalloffKind kind, float radius) {
  return rho_of({.kind = kind, .radius = radius});
}

TEST(Falloff, IsWhatItsDefinitionSays) {
  for (const float d : {0.0f, 0.1f, 0.5f, 1.999f, 2.0f, 2.001f, 7.0f, 1e6f, FLT_MAX}) {
    const double t = d / 2.0;
    EXPECT_EQ(evaluate(rho_of(FalloffKind::kConstant, 2), d), d <= 2 ? 1 : 0);
    EXPECT_NEAR(evaluate(rho_of(FalloffKind::kExponential, 2), d), std::exp(-t), 1e-7);
    EXPECT_NEAR(evaluate(rho_of(FalloffKind::kQuadratic, 2), d), t < 1 ? (1 - t) * (1 - t) : 0,
                1e-7);
    EXPECT_NEAR(evaluate(rho_of(FalloffKind::kInverseSquare, 2), d), 1 / (1 + t * t), 1e-7);
  }
}

TEST(Falloff, EndlessRadiusIsOneAtEveryDistance) {
  for (const FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kExponential,
                                 FalloffKind::kQuadratic, FalloffKind::kInverseSquare}) {
    for (const float d : {0.0f, 1.0f, FLT_MAX}) EXPECT_EQ(evaluate(rho_of(kind, kInf), d), 1);
  }
}

TEST(Falloff, SmallestRadiusLeavesOnlyDistanceZero) {
  for (const FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kExponential,
                                 FalloffKind::kQuadratic, FalloffKind::kInverseSquare}) {
    const math::Rho rho = rho_of(kind, FLT_TRUE_MIN);
    EXPECT_EQ(evaluate(rho, 0), 1);
    EXPECT_NEAR(evaluate(rho, 1e-30f), 0, 1e-12);
    EXPECT_EQ(evaluate(rho, FLT_MAX), 0);
  }
}

TEST(Falloff, TableIsLinearBetweenItsEntriesAndEndsAtTheRadius) {
  const math::Rho rho = rho_of({.kind = FalloffKind::kTable, .radius = 4, .table = {1, 0.5, 0.25}});
  EXPECT_FLOAT_EQ(evaluate(rho, 0), 1);
  EXPECT_FLOAT_EQ(evaluate(rho, 1), 0.75);
  EXPECT_FLOAT_EQ(evaluate(rho, 2), 0.5);
  EXPECT_FLOAT_EQ(evaluate(rho, 3), 0.375);
  EXPECT_FLOAT_EQ(evaluate(rho, 4), 0.25);
  EXPECT_EQ(evaluate(rho, 4.001f), 0);
  EXPECT_EQ(evaluate(rho, FLT_MAX), 0);
}

// At every scale of length, within the bound that math/falloff.h states.
TEST(Falloff, FunctionIsSampledWithinItsBound) {
  for (const float scale : {1e-6f, 0.02f, 1.0f, 3e3f, 1e9f}) {
    const math::Rho exponential = rho_of({.kind = FalloffKind::kFunction, .function = [=](float d) {
                                            return std::exp(-d / scale);
                                          }});
    const math::Rho step = rho_of({.kind = FalloffKind::kFunction,
                                   .function = [=](float d) { return d <= scale ? 1.0f : 0.0f; }});
    for (float t = 1e-4f; t < 100; t *= 1.0137f) {
      EXPECT_NEAR(evaluate(exponential, t * scale), std::exp(-t), 1.7e-5) << scale;
      if (std::abs(t - 1) > 1.0f / math::Rho::kPerOctave) {
        EXPECT_EQ(evaluate(step, t * scale), t < 1 ? 1 : 0) << scale << " " << t;
      }
    }
    EXPECT_EQ(evaluate(exponential, 0), 1);
    EXPECT_NEAR(evaluate(exponential, 1e-25f), 1, 1e-6);
    EXPECT_EQ(evaluate(exponential, FLT_MAX), 0);
  }
}

TEST(Falloff, RefusesBadFunctionsAndTables) {
  math::Rho rho;
  EXPECT_FALSE(make_rho({.kind = FalloffKind::kFunction, .function = nullptr}, &rho).ok());
  const Status s =
      make_rho({.kind = FalloffKind::kFunction, .function = [](float) { return 2.0f; }}, &rho);
  EXPECT_EQ(s.message(), "falloff.function(0) is 2; its values must be in [0, 1]");
  EXPECT_FALSE(
      make_rho({.kind = FalloffKind::kFunction, .function = [](float) { return NAN; }}, &rho).ok());
  EXPECT_FALSE(make_rho({.kind = FalloffKind::kTable, .table = {1}}, &rho).ok());
  EXPECT_FALSE(make_rho({.kind = FalloffKind::kQuadratic, .radius = 0}, &rho).ok());
  EXPECT_FALSE(make_rho({.kind = FalloffKind::kQuadratic, .radius = NAN}, &rho).ok());
}

TEST(Falloff, LanesAgreeWithScalarOnEveryTarget) {
  std::vector<float> distances = {0, FLT_TRUE_MIN, 1e-30f, 1, 2, 3, FLT_MAX};
  for (float d = 1e-3f; d < 1e3f; d *= 1.07f) distances.push_back(d);
  std::vector<math::Rho> all;
  for (const float radius : {1e-10f, 2.0f, kInf}) {
    for (const FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kExponential,
                                   FalloffKind::kQuadratic, FalloffKind::kInverseSquare}) {
      all.push_back(rho_of(kind, radius));
    }
  }
  all.push_back(
      rho_of({.kind = FalloffKind::kTable, .radius = 3, .table = {1, 0.7f, 0.1f, 0.05f}}));
  all.push_back(
      rho_of({.kind = FalloffKind::kFunction, .function = [](float d) { return 1 / (1 + d); }}));
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    for (const math::Rho& rho : all) {
      std::vector<float> lanes(distances.size());
      HWY_DYNAMIC_DISPATCH(EvaluateAll)
      (rho, distances.data(), static_cast<int>(distances.size()), lanes.data());
      for (std::size_t i = 0; i < distances.size(); ++i) {
        EXPECT_NEAR(lanes[i], evaluate(rho, distances[i]), kLaneTolerance)
            << hwy::TargetName(target) << " kind " << static_cast<int>(rho.kind) << " d "
            << distances[i];
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace obscura
#endif

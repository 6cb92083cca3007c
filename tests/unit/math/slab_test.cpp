// The integral over one azimuthal slice against direct quadrature of its definition, in double.
// Compiled once per SIMD target.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "math/falloff.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/unit/math/slab_test.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "math/slice-inl.h"

#ifndef OBSCURA_TESTS_UNIT_MATH_SLAB_TEST_ONCE
#define OBSCURA_TESTS_UNIT_MATH_SLAB_TEST_ONCE
namespace obscura {

struct SlicePoint {
  float x, y;
  bool valid = true;
  float share = 1;  // of the slice's width in which the point stands
};

struct SliceCase {
  float nz, nt;
  float camera = 1;
  bool perspective = true;
  bool chord = true;
  bool from_receiver = true;
  std::vector<SlicePoint> points{};
};

struct SliceResult {
  float sum, horizon;  // horizon: cosine of the smallest angle
};

}  // namespace obscura
#endif

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

template <FalloffKind kKind, bool kChord, bool kPartial>
SliceResult Evaluate(const math::Rho& rho, const SliceCase& c) {
  namespace hn = hwy::HWY_NAMESPACE;
  using leaf::real;
  leaf::SliceIntegral<kKind, kChord, SliceSums::kVisibility> slices(rho);
  const leaf::Slice s =
      leaf::make_slice(real(c.nz), real(c.nt), real(c.camera), real(c.perspective ? 1.0f : 0.0f));
  leaf::Horizon h = slices.start_horizon(s, c.from_receiver);
  for (const SlicePoint& p : c.points) {
    slices.add_point(s, real(p.x), real(p.y), leaf::leaf_truth(p.valid), kPartial, real(p.share),
                     h);
  }
  return {hn::GetLane(h.sum), hn::GetLane(h.cosine)};
}

SliceResult EvaluateAny(const math::Rho& rho, const SliceCase& c) {
  bool partial = false;
  for (const SlicePoint& p : c.points) partial = partial || p.share < 1;
  SliceResult result{};
  math::with_falloff_kind(rho.kind, [&]<FalloffKind kKind>() {
    if (c.chord) {
      result = partial ? Evaluate<kKind, true, true>(rho, c) : Evaluate<kKind, true, false>(rho, c);
    } else {
      result =
          partial ? Evaluate<kKind, false, true>(rho, c) : Evaluate<kKind, false, false>(rho, c);
    }
  });
  return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {
namespace {

HWY_EXPORT(EvaluateAny);

SliceResult evaluate_slice(const math::Rho& rho, const SliceCase& c) {
  return HWY_DYNAMIC_DISPATCH(EvaluateAny)(rho, c);
}

constexpr double kPi = std::numbers::pi;
constexpr float kInf = std::numeric_limits<float>::infinity();
// The fast arc cosine, sines and reciprocals of math/fast-inl.h, through differences.
constexpr double kTolerance = 3e-5;

math::Rho rho_of(const Falloff& falloff) {
  math::Rho rho;
  const Status s = math::make_rho(falloff, &rho);
  EXPECT_TRUE(s.ok()) << s.message();
  return rho;
}

// Integral over [low, high] of rho(distance to the line through (x, y) along (ex, ey)) times
// max(0, nz cos t + nt sin t) sin t, by `steps` midpoints.
double quadrature(const math::Rho& rho, const SliceCase& c, double x, double y, double ex,
                  double ey, double low, double high, int steps) {
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = low + (high - low) * (i + 0.5) / steps;
    const double lobe = std::max(0.0, c.nz * std::cos(t) + c.nt * std::sin(t)) * std::sin(t);
    // distance * (sin t, cos t) = (x, y) + s (ex, ey)
    const double determinant = std::sin(t) * ey - std::cos(t) * ex;
    const double distance = std::abs((x * ey - y * ex) / determinant);
    sum += lobe * math::evaluate(rho, static_cast<float>(std::min(distance, 1e30)));
  }
  return sum * (high - low) / steps;
}

// The estimator's definition, without its clipped bounds and its Gauss points: from pi downwards,
// each point below which nothing was seen fills the angles between its own and the smallest so far.
double define(const math::Rho& rho, const SliceCase& c, int steps = 4000) {
  double sum = 0, smallest = kPi, last_x = 0, last_y = 0;
  bool chord = c.from_receiver;
  for (const SlicePoint& p : c.points) {
    const double angle = std::atan2(p.x, p.y);
    const bool visible = p.valid && angle < smallest;
    if (visible) {
      double ex = c.perspective ? p.x : 0, ey = (c.perspective ? p.y : 0) - c.camera;
      double x = p.x;
      const double outwards = p.x - last_x, rise = p.y - last_y;
      if (c.chord && chord && outwards > 0 && rise > outwards) {
        // An edge halfway, with matter below it along the view ray.
        x -= 0.5 * outwards;
        ex = c.perspective ? x : 0;
      } else if (c.chord && chord) {
        ex = outwards, ey = rise;
      }
      sum += p.share * quadrature(rho, c, x, p.y, ex, ey, angle, smallest, steps);
      smallest += p.share * (angle - smallest);
    }
    chord = visible;
    last_x = p.x, last_y = p.y;
  }
  return sum;
}

// Points from the receiver outwards, each a little above or below the one before: the pieces are
// narrow, as they are in a depth image.
SliceCase random_case(Random& random) {
  const double tilt = (random.uniform() - 0.5) * 2 * kPi, length = 0.2 + 0.8 * random.uniform();
  SliceCase c{.nz = static_cast<float>(length * std::cos(tilt)),
              .nt = static_cast<float>(length * std::sin(tilt))};
  c.camera = static_cast<float>(3 + 10 * random.uniform());
  c.perspective = random.uniform() < 0.7;
  c.chord = random.uniform() < 0.5;
  c.from_receiver = random.uniform() < 0.5;
  double angle = kPi * (0.3 + 0.6 * random.uniform()), distance = 0.05;
  for (int i = 0; i < 12; ++i) {
    c.points.push_back({static_cast<float>(distance * std::sin(angle)),
                        static_cast<float>(distance * std::cos(angle)), random.uniform() < 0.9});
    angle = std::clamp(angle - 0.25 * (random.uniform() - 0.3), 0.1, 3.0);
    distance *= 1.2 + 0.3 * random.uniform();
  }
  return c;
}

std::vector<Falloff> every_falloff() {
  Falloff table{.kind = FalloffKind::kTable, .radius = 2};
  table.table = {1.0f, 0.9f, 0.5f, 0.2f, 0.0f};
  Falloff function{.kind = FalloffKind::kFunction};
  function.function = [](float d) { return 1 / (1 + d * d * d); };
  std::vector<Falloff> all = {table, function};
  for (const FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kExponential,
                                 FalloffKind::kQuadratic, FalloffKind::kInverseSquare}) {
    all.push_back({.kind = kind, .radius = 2});
  }
  return all;
}

// Three Gauss points leave what their falloff bends, or jumps, within a piece.
TEST(Slice, IsTheQuadratureOfItsDefinitionForEveryFalloff) {
  for (const Falloff& falloff : every_falloff()) {
    const math::Rho rho = rho_of(falloff);
    Random random(11);
    double worst = 0, mean = 0;
    constexpr int kCases = 200;
    for (int i = 0; i < kCases; ++i) {
      const SliceCase c = random_case(random);
      const double error = std::abs(evaluate_slice(rho, c).sum - define(rho, c, 200));
      worst = std::max(worst, error);
      mean += error / kCases;
    }
    EXPECT_LT(worst, 2e-3) << static_cast<int>(falloff.kind);
    EXPECT_LT(mean, 2e-4) << static_cast<int>(falloff.kind);
  }
}

// Without a falloff the distance does not count, so every piece is exact, however wide.
TEST(Slice, IsExactWithoutFalloff) {
  const math::Rho rho = rho_of({.kind = FalloffKind::kExponential, .radius = kInf});
  Random random(12);
  for (int i = 0; i < 200; ++i) {
    SliceCase c = random_case(random);
    for (SlicePoint& p : c.points) {
      const double angle = kPi * random.uniform();
      p.x = static_cast<float>(std::sin(angle)), p.y = static_cast<float>(std::cos(angle));
    }
    EXPECT_NEAR(evaluate_slice(rho, c).sum, define(rho, c), kTolerance) << i;
  }
}

// Normals in the slice at angle d from the zenith see [0, d + pi/2], or where they face away
// [d - pi/2, pi] and [d + 3 pi/2, pi]; the integral of rho = 1 from a to b is that of
// cos d sin^2(t)/2 + sin d (t - sin t cos t)/2.
TEST(Slice, HasTheClosedFormOfItsClippedBounds) {
  const math::Rho rho = rho_of({.kind = FalloffKind::kConstant, .radius = kInf});
  auto closed_form = [](double d, double t) {
    return std::cos(d) * std::sin(t) * std::sin(t) / 2 +
           std::sin(d) * (t - std::sin(t) * std::cos(t)) / 2;
  };
  for (int i = -31; i <= 31; ++i) {
    const double d = 0.1 * i;
    double from = 0, to = kPi;
    if (std::abs(d) <= kPi / 2) to = std::min(kPi, d + kPi / 2);
    if (d > kPi / 2) from = d - kPi / 2;
    if (d < -kPi / 2) from = d + 3 * kPi / 2;
    for (double angle = 0.05; angle < kPi; angle += 0.1) {
      const SliceCase c{
          .nz = static_cast<float>(std::cos(d)),
          .nt = static_cast<float>(std::sin(d)),
          .points = {{static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle))}}};
      const double low = std::max(from, angle);
      const double expected = low < to ? closed_form(d, to) - closed_form(d, low) : 0;
      EXPECT_NEAR(evaluate_slice(rho, c).sum, expected, kTolerance) << d << " " << angle;
    }
  }
}

// A wall along the view ray at distance 1, seen from its foot: slabs and chords are both the wall.
TEST(Slice, WallHasTheSameValueInOnePieceAndInMany) {
  const math::Rho rho = rho_of({.kind = FalloffKind::kExponential, .radius = 3});
  SliceCase whole{.nz = 1, .nt = 0, .camera = 1, .perspective = false, .from_receiver = false};
  whole.points = {{1, 2}};
  SliceCase parts = whole;
  parts.points.clear();
  for (int i = 1; i <= 32; ++i) parts.points.push_back({1, static_cast<float>(i / 16.0)});
  for (const bool chord : {false, true}) {
    whole.chord = parts.chord = chord;
    EXPECT_NEAR(evaluate_slice(rho, whole).sum, evaluate_slice(rho, parts).sum, 2e-3) << chord;
    EXPECT_NEAR(evaluate_slice(rho, parts).sum, define(rho, parts), kTolerance) << chord;
  }
}

TEST(Slice, SharesOfThePointsWeighPiecesAndMoveTheHorizon) {
  const math::Rho rho = rho_of({.kind = FalloffKind::kExponential, .radius = kInf});
  Random random(13);
  for (int i = 0; i < 100; ++i) {
    SliceCase c = random_case(random);
    for (SlicePoint& p : c.points) p.share = static_cast<float>(random.uniform());
    // The horizon goes through the fast arc cosine and back once per point.
    EXPECT_NEAR(evaluate_slice(rho, c).sum, define(rho, c), 4 * kTolerance) << i;
  }
}

// Every point of a plane is on its horizon: what stands on the plane begins at its last point, on
// whichever side of the plane rounding has put that.
TEST(Slice, RoundingDoesNotDecideWhatStandsOnAPlane) {
  const math::Rho rho = rho_of({.kind = FalloffKind::kInverseSquare, .radius = 1});
  for (const float side : {-1.0f, 1.0f}) {
    SliceCase c{.nz = 0.6f, .nt = 0.8f};
    for (int i = 1; i <= 4; ++i) {
      c.points.push_back({1.0f * i, -4.0f / 3 * i * (1 + (i % 2 ? side : -side) * 1e-6f)});
    }
    c.points.push_back({6, -6});
    SliceCase exact = c;
    for (int i = 0; i < 4; ++i) exact.points[i].y = -4.0f / 3 * exact.points[i].x;
    EXPECT_NEAR(evaluate_slice(rho, c).sum, evaluate_slice(rho, exact).sum, 1e-4) << side;
    // As from the last point of the plane to the first one above it.
    const SliceCase two{.nz = c.nz, .nt = c.nt, .points = {c.points[3], c.points[4]}};
    EXPECT_NEAR(evaluate_slice(rho, c).sum, evaluate_slice(rho, two).sum, 1e-4) << side;
  }
}

TEST(Slice, PointsThatAreNotThereChangeNothing) {
  const math::Rho rho = rho_of({.kind = FalloffKind::kExponential, .radius = 2});
  SliceCase c{.nz = 0.8f, .nt = 0.6f, .points = {{1, 0.1f}, {2, 1}}};
  const SliceResult before = evaluate_slice(rho, c);
  c.points.push_back({3, 9, false});
  c.points.push_back({3, 0.1f});
  EXPECT_EQ(evaluate_slice(rho, c).sum, before.sum);
  EXPECT_EQ(evaluate_slice(rho, c).horizon, before.horizon);
  c.points.push_back({3, 9, true, 0});
  EXPECT_NEAR(evaluate_slice(rho, c).sum, before.sum, 1e-6);
  EXPECT_NEAR(evaluate_slice(rho, c).horizon, before.horizon, 1e-5);
}

// Receivers and points at the ends of what floats hold.
TEST(Slice, StaysFiniteAtExtremes) {
  const math::Rho rho = rho_of({.kind = FalloffKind::kInverseSquare, .radius = 1});
  for (const float size : {1e-9f, 1e-3f, 1.0f, 1e6f, 1e9f}) {
    for (const float nz : {-1.0f, 0.0f, 1.0f}) {
      SliceCase c{.nz = nz, .nt = 0, .camera = size};
      c.points = {{0, 0}, {0, size}, {size, 0}, {0, -size}, {1e-6f * size, size}, {size, size}};
      const float sum = evaluate_slice(rho, c).sum;
      EXPECT_GE(sum, 0) << size << " " << nz;
      EXPECT_LE(sum, 0.5f + 1e-5f) << size << " " << nz;
    }
  }
}

TEST(Slice, EveryTargetAgrees) {
  const math::Rho rho = rho_of({.kind = FalloffKind::kExponential, .radius = 2});
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    Random random(14);
    for (int i = 0; i < 50; ++i) {
      const SliceCase c = random_case(random);
      hwy::SetSupportedTargetsForTest(0);
      const float best = evaluate_slice(rho, c).sum;
      hwy::SetSupportedTargetsForTest(target);
      EXPECT_NEAR(evaluate_slice(rho, c).sum, best, kTolerance) << hwy::TargetName(target);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace obscura
#endif  // HWY_ONCE

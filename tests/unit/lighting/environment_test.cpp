#include "obscura/environment.h"

#include <limits>

#include "tests/unit/lighting/environments.h"

namespace obscura {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Environment, LinearLightComesBackAsItIs) {
  const Environment e = make_environment([](const Direction& d) {
    return Direction{1 + d[0], 2 + d[1], 3 + d[2]};
  });
  for (const Direction& d : directions()) {
    const auto rgb = e.radiance(d);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c], c + 1 + d[c], 0.02);
  }
}

TEST(Environment, TinyMapsWork) {
  const Environment e = make_environment([](const Direction&) { return Direction{3, 2, 1}; }, 4);
  for (const Direction& d : directions()) {
    const auto rgb = e.radiance(d);
    EXPECT_NEAR(rgb[0], 3, 1e-5);
    EXPECT_NEAR(rgb[2], 1, 1e-5);
  }
}

// Both sides of cube edges agree, and corners too.
TEST(Environment, HasNoSeams) {
  const Environment e = make_environment([](const Direction& d) {
    const float v = 1 + std::sin(9 * d[0]) * std::cos(7 * d[1] + 5 * d[2]);
    return Direction{v, v, v};
  });
  for (const Direction& d : directions()) {
    for (int axis = 0; axis < 3; ++axis) {
      Direction a = d, b = d;
      a[axis] += 1e-5f, b[axis] -= 1e-5f;
      EXPECT_NEAR(e.radiance(a)[0], e.radiance(b)[0], 1e-3);
    }
  }
}

TEST(Environment, BadPixelsAreMendedAndCounted) {
  std::vector<float> pixels = lat_long(64, 32, [](const Direction&) { return Direction{1, 1, 1}; });
  pixels[0] = kNan;
  pixels[30] = -5;
  pixels[60] = kInf;
  pixels[63] = 3e38f;
  pixels[90] = -kInf;
  Environment e;
  EnvironmentRepairs repairs;
  ASSERT_TRUE(Environment::from_lat_long(VectorView<float>::interleaved(pixels.data(), 64, 32), &e,
                                         &repairs)
                  .ok());
  EXPECT_EQ(repairs.not_a_number, 1);
  EXPECT_EQ(repairs.negative, 2);
  EXPECT_EQ(repairs.infinite, 1);
  EXPECT_EQ(repairs.too_large, 1);
  for (const Direction& d : directions()) {
    for (float v : e.radiance(d)) EXPECT_TRUE(std::isfinite(v) && v >= 0);
  }
}

TEST(Environment, RefusesWhatIsNoMap) {
  std::vector<float> pixels(64 * 64 * 3, 1.0f);
  auto make = [&](int w, int h) {
    Environment e;
    return Environment::from_lat_long(VectorView<float>::interleaved(pixels.data(), w, h), &e)
        .message();
  };
  EXPECT_EQ(make(32, 32),
            "the environment is 32x32; a latitude-longitude map is twice as wide as high, from "
            "4x2 to 32768x16384");
  EXPECT_NE(make(2, 1), "");
  EXPECT_NE(make(0, 0), "");
  for (float& p : pixels) p = kNan;
  EXPECT_NE(make(64, 32), "");
  Environment e;
  EXPECT_FALSE(Environment::from_lat_long({}, &e).ok());
}

double luminance(const std::array<float, 3>& c) {
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

// Mean of the light over a cosine-weighted hemisphere around +y.
double white_ground(const Environment& e) {
  double sum = 0;
  const int n = 200;
  for (int i = 0; i < n; ++i) {
    const double y = std::sqrt((i + 0.5) / n), r = std::sqrt(1 - y * y);
    for (int j = 0; j < n; ++j) {
      const double phi = 2 * std::numbers::pi * (j + 0.5) / n;
      sum += luminance(e.radiance(unit(r * std::cos(phi), y, r * std::sin(phi))));
    }
  }
  return sum / (n * n);
}

TEST(Environment, SkiesAreScaledToWhiteGround) {
  for (SkyModel model : {SkyModel::kClear, SkyModel::kOvercast, SkyModel::kUniform}) {
    Environment e;
    ASSERT_TRUE(Environment::from_sky({.model = model, .intensity = 2}, &e).ok());
    EXPECT_NEAR(white_ground(e), 2, 0.02) << enum_name(model);
    EXPECT_EQ(e.sun().shines(), model == SkyModel::kClear);
  }
}

// The CIE overcast sky is three times as bright in the zenith as on the horizon; 9/7 of its mean.
TEST(Environment, OvercastSkyHasItsKnownShape) {
  Environment e;
  ASSERT_TRUE(Environment::from_sky({.model = SkyModel::kOvercast, .ground_albedo = 0}, &e).ok());
  EXPECT_NEAR(e.radiance({0, 1, 0})[1], 9.0 / 7, 0.005);
  EXPECT_NEAR(e.radiance(unit(1, 1, 0))[1], 9.0 / 7 * (1 + std::sqrt(2.0)) / 3, 0.005);
  EXPECT_EQ(e.radiance(unit(1, -0.2, 0))[1], 0);
}

TEST(Environment, ClearSkyIsBrightestAroundTheSunAndBlueAwayFromIt) {
  Environment e;
  const SkySettings sky{.elevation_deg = 30, .azimuth_deg = 90, .turbidity = 3};
  ASSERT_TRUE(Environment::from_sky(sky, &e).ok());
  const Direction sun = e.sun().direction;
  EXPECT_NEAR(sun[0], std::sqrt(0.75), 1e-6);  // the right
  EXPECT_NEAR(sun[1], 0.5, 1e-6);
  const auto away = e.radiance(unit(-0.5, 0.8, 0));
  EXPECT_GT(luminance(e.radiance(sun)), 2 * luminance(away));
  EXPECT_GT(away[2], 1.3 * away[0]);
  // A low sun is redder.
  const auto colour = e.sun().irradiance;
  EXPECT_GT(colour[0], colour[2]);
}

TEST(Environment, SkyAndSunSettingsAreChecked) {
  Environment e, other;
  EXPECT_EQ(Environment::from_sky({.turbidity = 1}, &e).message(),
            "turbidity is 1; it must be in [2, 10]");
  EXPECT_FALSE(e.with_sun({}, &other).ok());
  ASSERT_TRUE(Environment::from_sky({}, &e).ok());
  EXPECT_FALSE(e.with_sun({.direction = {0, 0, 0}}, &other).ok());
  EXPECT_FALSE(e.with_sun({.direction = {kNan, 0, 1}}, &other).ok());
  EXPECT_FALSE(e.with_sun({.irradiance = {-1, 0, 0}}, &other).ok());
  EXPECT_FALSE(e.with_sun({.angular_radius = 2}, &other).ok());
  ASSERT_TRUE(e.with_sun({.direction = {0, 5, 0}, .irradiance = {1, 1, 1}}, &other).ok());
  EXPECT_EQ(other.sun().direction[1], 1);
}

TEST(Environment, BitsDoNotDependOnThreads) {
  std::vector<float> pixels = lat_long(128, 64, [](const Direction& d) {
    return Direction{1 + d[0], std::abs(d[1]), 1 - d[2]};
  });
  const auto view = VectorView<float>::interleaved(pixels.data(), 128, 64);
  Environment a, b;
  const auto one = make_executor(1), three = make_executor(3);
  ASSERT_TRUE(Environment::from_lat_long(view, &a, nullptr, {.executor = one.get()}).ok());
  ASSERT_TRUE(Environment::from_lat_long(view, &b, nullptr, {.executor = three.get()}).ok());
  for (const Direction& d : directions()) EXPECT_EQ(a.radiance(d), b.radiance(d));
}

}  // namespace
}  // namespace obscura

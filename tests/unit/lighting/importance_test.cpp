#include "obscura/importance.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "tests/property/synthetic.h"
#include "tests/unit/lighting/environments.h"

namespace obscura {
namespace {

std::vector<float> lit(const DepthField& field, const Environment& environment,
                       const ImportanceSettings& settings, int threads = 1) {
  const int w = field.visible().width, h = field.visible().height;
  std::vector<float> rgb(std::size_t{3} * w * h, -1.0f);
  const auto executor = make_executor(threads);
  RunOptions options;
  options.executor = executor.get();
  const Status s = light_by_importance(field, environment, settings,
                                       VectorView<float>::interleaved(rgb.data(), w, h), options);
  EXPECT_TRUE(s.ok()) << s.message();
  return rgb;
}

double mean(const std::vector<float>& v, int channel) {
  double sum = 0;
  for (std::size_t i = channel; i < v.size(); i += 3) sum += v[i];
  return sum / (v.size() / 3);
}

synthetic::Input wall() {
  return synthetic::plane(64, 48, Camera::perspective(1, 64, 48), 0, 0, 1, 5);
}

TEST(Importance, UniformLightOnAnOpenWallIsItself) {
  Environment sky;
  ASSERT_TRUE(Environment::from_sky({.model = SkyModel::kUniform}, &sky).ok());
  const std::vector<float> rgb = lit(wall().field(), sky, {.samples = 64});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean(rgb, c), 1, 0.01);
}

// A sun alone: E/pi (n.s), from a few directions only.
TEST(Importance, TheSunIsFound) {
  Environment sky, sunny;
  ASSERT_TRUE(Environment::from_sky({.model = SkyModel::kUniform, .intensity = 1e-4f}, &sky).ok());
  Sun sun;
  sun.direction = {0.6f, 0, 0.8f};
  sun.irradiance = {3, 2, 1};
  ASSERT_TRUE(sky.with_sun(sun, &sunny).ok());
  const std::vector<float> rgb = lit(wall().field(), sunny, {.samples = 16});
  EXPECT_NEAR(mean(rgb, 0), 3 * 0.8 / 3.14159265, 0.01);
  EXPECT_NEAR(mean(rgb, 2), 1 * 0.8 / 3.14159265, 0.01);
}

// Light only from one side, and a step that stands on that side.
TEST(Importance, MatterCastsShadow) {
  Environment sky, sunny;
  ASSERT_TRUE(Environment::from_sky({.model = SkyModel::kUniform, .intensity = 1e-4f}, &sky).ok());
  Sun sun;
  sun.direction = {0.8f, 0, 0.6f};
  sun.irradiance = {1, 1, 1};
  ASSERT_TRUE(sky.with_sun(sun, &sunny).ok());
  synthetic::Input in = wall();
  in.normals.clear();
  for (int y = 0; y < 48; ++y) {
    for (int x = 40; x < 64; ++x) in.depth[y * 64 + x] = 3;
  }
  const ImportanceSettings settings{.falloff = {.kind = FalloffKind::kConstant, .radius = 4},
                                    .samples = 16,
                                    .steps = 32,
                                    .blur = false};
  const std::vector<float> rgb = lit(in.field(), sunny, settings);
  EXPECT_LT(rgb[3 * (24 * 64 + 34)], 0.02f);  // in the step's shadow
  EXPECT_GT(rgb[3 * (24 * 64 + 5)], 0.17f);   // far from it: 0.6 / pi = 0.19
  EXPECT_EQ(std::memcmp(rgb.data(), lit(in.field(), sunny, settings, 3).data(),
                        rgb.size() * sizeof(float)),
            0);
}

TEST(Importance, WrongSettingsAreRefused) {
  Environment sky;
  ASSERT_TRUE(Environment::from_sky({}, &sky).ok());
  const synthetic::Input in = wall();
  std::vector<float> rgb(std::size_t{3} * 64 * 48);
  const auto view = VectorView<float>::interleaved(rgb.data(), 64, 48);
  EXPECT_FALSE(light_by_importance(in.field(), sky, {.samples = 0}, view).ok());
  EXPECT_FALSE(light_by_importance(in.field(), Environment(), {}, view).ok());
  EXPECT_FALSE(light_by_importance(in.field(), sky, {.falloff = {.radius = -1}}, view).ok());
  EXPECT_FALSE(
      light_by_importance(in.field(), sky, {}, VectorView<float>::interleaved(rgb.data(), 32, 48))
          .ok());
}

}  // namespace
}  // namespace obscura

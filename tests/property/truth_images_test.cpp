// Regression thresholds: methods at their defaults against the traced references in tests/truth
// (make.sh says how they are made), so that a clone holds them without any other file.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/images/files.h"
#include "obscura/estimator.h"
#include "paths.h"
#include "scene/scenes/load_scene.h"
#include "scene/truth/compare.h"

namespace obscura {
namespace {

struct Scene {
  Scene(const char* name, float length) : radius(length) {
    const std::string file = std::string(OBSCURA_SOURCE_DIR "/tests/truth/") + name + ".exr";
    EXPECT_TRUE(tools::read_image(file, &truth).ok()) << file;
    EXPECT_TRUE(tools::load_scene(std::string("scene:") + name, &input).ok());
    const GuardBand& g = input.guard_band;
    mask = {input.depth.data() + std::ptrdiff_t{g.top} * input.width + g.left, kWidth, kHeight,
            input.width};
  }

  const tools::Image::Channel& channel(const char* name) const {
    for (const tools::Image::Channel& c : truth.channels) {
      if (c.name == name || truth.channels.size() == 1) return c;
    }
    ADD_FAILURE() << "no channel " << name;
    return truth.channels[0];
  }

  static constexpr int kWidth = 640, kHeight = 360;
  float radius;
  tools::Image truth;
  tools::DepthInput input;
  ImageView<const float> mask;
};

using Values = std::vector<float>;

// e_A of a method at its defaults but for the falloff.
template <class Settings>
double error(const Scene& scene) {
  Settings settings;
  settings.falloff.radius = scene.radius;
  if constexpr (requires { settings.occluder; }) settings.occluder = Occluder::solid();
  Values v(Scene::kWidth * Scene::kHeight);
  const Status s = compute(scene.input.field(), settings,
                           {.visibility = {v.data(), Scene::kWidth, Scene::kHeight}});
  EXPECT_TRUE(s.ok()) << s.message();
  tools::Comparison c;
  EXPECT_TRUE(
      tools::compare({v.data(), Scene::kWidth, Scene::kHeight},
                     {scene.channel("visibility").values.data(), Scene::kWidth, Scene::kHeight},
                     scene.mask, &c)
          .ok());
  return c.e_a;
}

// In degrees, the mean over traced pixels that are not nearly closed (cones above 5 degrees): the
// angle between a method's bent normals and the traced ones, and the mean difference of the cones.
struct Angles {
  double direction = 0, cone = 0;
};
template <class Settings>
Angles angles(const Scene& scene) {
  Settings settings;
  settings.falloff.radius = scene.radius;
  if constexpr (requires { settings.occluder; }) settings.occluder = Occluder::solid();
  const std::size_t pixels = Scene::kWidth * Scene::kHeight;
  Values bent[3] = {Values(pixels), Values(pixels), Values(pixels)}, cone(pixels), v(pixels);
  auto view = [](Values& values) {
    return ImageView<float>(values.data(), Scene::kWidth, Scene::kHeight);
  };
  const Status s = compute(scene.input.field(), settings,
                           {.visibility = view(v),
                            .bent_normal = {view(bent[0]), view(bent[1]), view(bent[2])},
                            .cone_angle = view(cone)});
  EXPECT_TRUE(s.ok()) << s.message();
  const Values* truth[] = {&scene.channel("bent-normal.X").values,
                           &scene.channel("bent-normal.Y").values,
                           &scene.channel("bent-normal.Z").values};
  const Values& wide = scene.channel("cone-angle").values;
  Angles sum;
  int count = 0;
  constexpr double kDegrees = 57.29577951308232;
  for (std::size_t i = 0; i < pixels; ++i) {
    const int x = static_cast<int>(i % Scene::kWidth), y = static_cast<int>(i / Scene::kWidth);
    if (!std::isfinite(scene.mask(x, y)) || !(wide[i] > 5 / kDegrees)) continue;
    double cosine = 0;
    for (int k = 0; k < 3; ++k) cosine += double{bent[k][i]} * (*truth[k])[i];
    sum.direction += std::acos(std::min(1.0, cosine)) * kDegrees;
    sum.cone += std::abs(cone[i] - wide[i]) * kDegrees;
    ++count;
  }
  EXPECT_GT(count, 300);
  return {sum.direction / count, sum.cone / count};
}

// Each threshold is a tenth above what was measured when it was set.
TEST(TruthImages, Hall) {
  const Scene scene("hall", 2);
  EXPECT_LE(error<FarFieldSettings>(scene), 1.26);
  EXPECT_LE(error<HorizonSettings>(scene), 4.3);
  EXPECT_LE(error<MipmapSettings>(scene), 10.2);
}

TEST(TruthImages, Meadow) {
  const Scene scene("meadow", 1);
  EXPECT_LE(error<FarFieldSettings>(scene), 1.1);
  EXPECT_LE(error<HorizonSettings>(scene), 11.3);
  EXPECT_LE(error<MipmapSettings>(scene), 14.8);
}

TEST(TruthImages, Tower) {
  const Scene scene("tower", 1);
  EXPECT_LE(error<FarFieldSettings>(scene), 0.74);
  const Angles far_field = angles<FarFieldSettings>(scene);
  EXPECT_LE(far_field.direction, 1.63);
  EXPECT_LE(far_field.cone, 1.2);
  const Angles hemisphere = angles<HemisphereSettings>(scene);
  EXPECT_LE(hemisphere.direction, 6.0);
  EXPECT_LE(hemisphere.cone, 3.5);
}

}  // namespace
}  // namespace obscura

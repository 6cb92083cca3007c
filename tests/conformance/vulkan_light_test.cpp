#include "core/random.h"
#include "obscura/lighting.h"
#include "tests/conformance/vulkan_fixture.h"

namespace obscura {
namespace {

// What the light reads and writes, of any values.
struct LightImages {
  LightImages(int width, int height, std::uint64_t seed) : w(width), h(height) {
    Random random(seed);
    for (auto& plane : planes) plane.resize(std::size_t(w) * h);
    for (std::size_t i = 0; i < planes[0].size(); ++i) {
      auto direction = [&](int first, float spread) {
        for (int k = 0; k < 3; ++k) {
          planes[first + k][i] = static_cast<float>(2 * random.uniform() - 1) * spread;
        }
      };
      planes[0][i] = static_cast<float>(random.uniform());
      direction(1, 1);
      direction(4, 0.5f);
      for (int k = 0; k < 3; ++k) planes[4 + k][i] += 0.7f * planes[1 + k][i];
      planes[7][i] = static_cast<float>(1.6 * random.uniform());
      for (int k = 8; k < 11; ++k) planes[k][i] = static_cast<float>(random.uniform());
    }
  }
  // What is wrong with a pixel is mended, on both devices alike.
  void spoil() {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (int plane = 0; plane < 8; ++plane) {
      planes[plane][3 * plane] = nan;
      planes[plane][3 * plane + 1] = std::numeric_limits<float>::infinity();
      planes[plane][3 * plane + 2] = 0;
    }
  }
  LightingInputs inputs(bool bent, bool albedo) {
    LightingInputs in{.visibility = view(0), .normal = vector(1)};
    if (bent) in.bent_normal = vector(4), in.cone_angle = view(7);
    if (albedo) in.albedo = vector(8);
    return in;
  }
  ImageView<float> view(int plane) { return {planes[plane].data(), w, h}; }
  VectorView<float> vector(int plane) { return {view(plane), view(plane + 1), view(plane + 2)}; }

  int w, h;
  std::vector<float> planes[11];
};

class VulkanLight : public VulkanTest {
 protected:
  static PreconvolvedEnvironment convolved(const Environment& environment) {
    PreconvolvedEnvironment lights;
    EXPECT_TRUE(PreconvolvedEnvironment::make(environment, {}, &lights).ok());
    return lights;
  }
  static PreconvolvedEnvironment sky(SkyModel model) {
    Environment environment;
    EXPECT_TRUE(Environment::from_sky({.model = model}, &environment).ok());
    return convolved(environment);
  }
  // A map of a few bright windows on black, in colour.
  static PreconvolvedEnvironment windows() {
    constexpr int kWidth = 64, kHeight = 32;
    std::vector<float> rgb(3 * kWidth * kHeight, 0.0f);
    for (int y = 6; y < 20; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (x % 16 < 4) rgb[3 * (y * kWidth + x) + x / 16 % 3] = 10;
      }
    }
    Environment environment;
    EXPECT_TRUE(Environment::from_lat_long(
                    VectorView<const float>::interleaved(rgb.data(), kWidth, kHeight), &environment)
                    .ok());
    return convolved(environment);
  }

  // Mean difference at most 2e-3 of the picture's mean; 99.9 % of the pixels within 1 % of their
  // value, or of a tenth of the mean where they are darker than that.
  static void expect_same_light(const LightingInputs& in, const PreconvolvedEnvironment& lights,
                                const LightingSettings& settings, const std::string& what) {
    const int w = in.visibility.width, h = in.visibility.height;
    const std::size_t count = std::size_t(w) * h;
    std::vector<float> cpu(3 * count), gpu(3 * count);
    auto planes = [&](std::vector<float>& v) {
      return VectorView<float>::interleaved(v.data(), w, h);
    };
    const Status on_cpu = light(in, lights, settings, planes(cpu));
    ASSERT_TRUE(on_cpu.ok()) << what << ": " << on_cpu.message();
    const Status on_gpu = vulkan_->light(in, lights, settings, planes(gpu));
    ASSERT_TRUE(on_gpu.ok()) << what << ": " << on_gpu.message();
    double mean = 0, difference = 0;
    for (std::size_t i = 0; i < cpu.size(); ++i) {
      mean += cpu[i] / double(cpu.size());
      difference += std::abs(double{cpu[i]} - gpu[i]) / double(cpu.size());
    }
    EXPECT_GT(mean, 0) << what;
    EXPECT_LE(difference, 2e-3 * mean) << what;
    std::size_t close = 0;
    for (std::size_t i = 0; i < count; ++i) {
      bool all = true;
      for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
        all = all && std::abs(cpu[c] - gpu[c]) <= 0.01 * std::max<double>(cpu[c], 0.1 * mean);
      }
      close += all;
    }
    EXPECT_GE(double(close), 0.999 * double(count)) << what;
    for (const std::string& message : vulkan_->messages()) ADD_FAILURE() << what << ": " << message;
  }

  static std::vector<LightingSettings> all_settings() {
    std::vector<LightingSettings> all;
    for (const LightingTechnique technique :
         {LightingTechnique::kAmbientOcclusion, LightingTechnique::kBentNormal,
          LightingTechnique::kBentCone}) {
      for (int bits = 0; bits < 8; ++bits) {
        LightingSettings s{.technique = technique, .geometric_term = (bits & 1) != 0};
        if (bits & 2) s.normalisation = ConeNormalisation::kPaper;
        if (bits & 4) s.weights = VisibilityWeights::kUniform;
        s.world_from_eye = {0.6f, 0, 0.8f, 0, 1, 0, -0.8f, 0, 0.6f};
        all.push_back(s);
      }
    }
    return all;
  }
  static std::string name(const LightingSettings& s) {
    std::string all;
    visit_fields(s, [&](const auto& value, const Field& field) {
      all += std::string(field.name) + "=" + write_setting(value) + " ";
    });
    return all;
  }
};

TEST_F(VulkanLight, EverySettingAgreesUnderEverySky) {
  LightImages images(73, 50, 7);
  images.spoil();
  const PreconvolvedEnvironment environments[] = {sky(SkyModel::kClear), sky(SkyModel::kOvercast),
                                                  sky(SkyModel::kUniform), windows()};
  int number = 0;
  for (const PreconvolvedEnvironment& lights : environments) {
    for (const LightingSettings& s : all_settings()) {
      const bool bent = s.technique != LightingTechnique::kAmbientOcclusion;
      expect_same_light(images.inputs(bent, number++ % 2 == 0), lights, s, name(s));
    }
  }
}

// Visibility, bent normals and cones of four scenes of blocks.
TEST_F(VulkanLight, ScenesAgree) {
  const PreconvolvedEnvironment lights = sky(SkyModel::kClear);
  for (int scene = 0; scene < 4; ++scene) {
    const synthetic::Input in =
        synthetic::blocks(96, 64, Camera::perspective(1, 96, 64), 11 + std::uint64_t(scene));
    LightImages images(96, 64, 1);
    ASSERT_TRUE(compute(in.field(), HorizonSettings{},
                        {.visibility = images.view(0),
                         .bent_normal = images.vector(4),
                         .cone_angle = images.view(7),
                         .normal = images.vector(1)})
                    .ok());
    for (const LightingTechnique technique :
         {LightingTechnique::kAmbientOcclusion, LightingTechnique::kBentNormal,
          LightingTechnique::kBentCone}) {
      const bool bent = technique != LightingTechnique::kAmbientOcclusion;
      expect_same_light(images.inputs(bent, false), lights, {.technique = technique},
                        "scene " + std::to_string(scene));
    }
  }
}

// Under light that is the same from everywhere an open pixel shows that light, whatever its cone.
TEST_F(VulkanLight, ConstantLightStaysConstant) {
  LightImages images(40, 30, 3);
  images.planes[0].assign(images.planes[0].size(), 1.0f);
  std::vector<float> rgb(3 * images.planes[0].size());
  const auto out = VectorView<float>::interleaved(rgb.data(), 40, 30);
  for (const LightingTechnique technique :
       {LightingTechnique::kAmbientOcclusion, LightingTechnique::kBentNormal,
        LightingTechnique::kBentCone}) {
    const bool bent = technique != LightingTechnique::kAmbientOcclusion;
    ASSERT_TRUE(vulkan_
                    ->light(images.inputs(bent, false), sky(SkyModel::kUniform),
                            {.technique = technique}, out)
                    .ok());
    for (const float v : rgb) EXPECT_NEAR(v, 1.0f, 0.005f);
  }
}

TEST_F(VulkanLight, RefusesWhatCannotBe) {
  LightImages images(8, 6, 3);
  const PreconvolvedEnvironment lights = sky(SkyModel::kUniform);
  std::vector<float> rgb(3 * images.planes[0].size());
  const auto out = VectorView<float>::interleaved(rgb.data(), 8, 6);
  Status s = vulkan_->light(images.inputs(false, false), lights, {}, out);
  EXPECT_EQ(s.code(), StatusCode::kInvalidArgument);
  EXPECT_NE(s.message().find("bent-cone needs directions"), std::string::npos) << s.message();
  s = vulkan_->light(images.inputs(true, false), lights,
                     {.world_from_eye = {2, 0, 0, 0, 1, 0, 0, 0, 1}}, out);
  EXPECT_NE(s.message().find("world_from_eye"), std::string::npos) << s.message();
  s = vulkan_->light(images.inputs(true, false), {}, {}, out);
  EXPECT_EQ(s.code(), StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace obscura

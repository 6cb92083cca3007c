#include "scene/scenes/load_scene.h"
#include "tests/conformance/vulkan_fixture.h"

// CPU against Vulkan at the size of a real image, every method and every model of matter that it
// takes. Too slow on a software device for every change.
namespace obscura {
namespace {

struct Scene {
  const char* name;
  float radius_of_scene;  // radius as a share of the scene's size
};

class VulkanRealSizeTest : public VulkanTest, public ::testing::WithParamInterface<Scene> {
 protected:
  void SetUp() override {
    VulkanTest::SetUp();
    tools::ViewOptions options;
    options.size = {640, 360};
    options.back_depth = true;
    const auto executor = make_executor(0);
    const Status s =
        tools::load_scene("scene:" + std::string(GetParam().name), options, *executor, &rendering_);
    ASSERT_TRUE(s.ok()) << s.message();
  }

  // Whether the method takes the model of matter that its settings name, on both devices alike.
  bool takes_matter(const DepthField& field, const MethodSettings& settings) {
    std::vector<float> v(std::size_t(field.visible().width) * field.visible().height);
    const Outputs outputs{.visibility = {v.data(), field.visible().width, field.visible().height}};
    const Status on_cpu = compute(field, settings, outputs);
    if (on_cpu.ok()) return true;
    EXPECT_TRUE(on_cpu.message().starts_with("occluder is")) << on_cpu.message();
    EXPECT_EQ(vulkan_->run(field, settings, outputs).message(), on_cpu.message());
    return false;
  }

  tools::Rendering rendering_;
};

template <class Settings>
concept TakesOccluders = requires(Settings s) {
  s.occluder;
};

TEST_P(VulkanRealSizeTest, EveryMethodAgreesWithTheCpu) {
  const DepthField field = rendering_.gbuffer.field();
  const float size = float(rendering_.gbuffer.scene_size);
  for_each_method([&](auto info, auto settings) {
    if constexpr (!info.on_vulkan) {
      return;
    } else {
      settings.falloff.radius = GetParam().radius_of_scene * size;
      const std::string what = std::string(GetParam().name) + ", " + std::string(info.name);
      if constexpr (TakesOccluders<decltype(settings)>) {
        for (const Occluder& matter : {Occluder::solid(), Occluder::of_thickness(0.01f * size),
                                       Occluder::back_depth(), Occluder::automatic()}) {
          settings.occluder = matter;
          if (!takes_matter(field, settings)) continue;
          // Against solid matter the far field asks whether the last point was visible, a yes or no
          // that rounding can turn round (docs/status.md): 97.5 % in the hall.
          const bool adaptive = matter.kind == OccluderKind::kSolid &&
                                std::is_same_v<decltype(settings), FarFieldSettings>;
          close_share_ = adaptive ? 0.97 : 0.999;
          expect_same(field, settings, what + ", " + SettingText<Occluder>::write(matter));
        }
      } else {
        close_share_ = 0.999;
        expect_same(field, settings, what);
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Scenes, VulkanRealSizeTest,
                         ::testing::Values(Scene{"hall", 0.05f}, Scene{"meadow", 0.04f},
                                           Scene{"tower", 0.05f}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace obscura

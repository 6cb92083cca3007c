#include <functional>

#include "tests/conformance/vulkan_fixture.h"

namespace obscura {
namespace {

using VulkanClosed = VulkanTest;

constexpr int kSide = 33, kMiddle = kSide / 2 * kSide + kSide / 2;

// A hole a pixel wide and 1,250 pixels deep: from its ground no direction is open.
synthetic::Input hole() {
  synthetic::Input in = synthetic::plane(
      kSide, kSide, Camera::orthographic_height(0.08f * kSide, kSide, kSide), 0, 0, 1, 1);
  in.depth[kMiddle] = 101;
  return in;
}

// A closed point has its normal and the angle 0: in every method that gives directions, on the
// processor and on Vulkan.
TEST_F(VulkanClosed, PointsHaveOneDirectionAndOneAngle) {
  const Falloff falloff{.kind = FalloffKind::kConstant, .radius = 190};
  HemisphereSettings hemisphere{.occluder = Occluder::solid()};
  hemisphere.falloff = {.kind = FalloffKind::kConstant, .radius = 1};
  hemisphere.blur = false;
  HorizonSettings horizon{.occluder = Occluder::solid()};
  horizon.falloff = falloff;
  horizon.blur = false;
  HorizonSettings classic = horizon;
  classic.variant = HorizonVariant::kClassic;
  classic.falloff.radius = 1e6f;  // its weights fall with the distance
  classic.angle_bias = 0;
  FarFieldSettings far_field{.occluder = Occluder::solid()};
  far_field.falloff = falloff;
  PointSettings point;
  point.pattern = PointPattern::kScreen;
  point.falloff = falloff;
  point.blur = false;
  ReferenceSettings traced{.occluder = Occluder::solid()};
  traced.falloff = falloff;
  traced.rays = 64;
  const struct {
    const char* name;
    MethodSettings settings;
    bool vulkan;
  } methods[] = {{"hemisphere", hemisphere, true}, {"horizon", horizon, true},
                 {"classic", classic, true},       {"far field", far_field, true},
                 {"point", point, true},           {"ray-traced", traced, false}};
  const synthetic::Input in = hole();
  for (const auto& method : methods) {
    for (ConeEstimate cone : {ConeEstimate::kExact, ConeEstimate::kPaper}) {
      MethodSettings settings = method.settings;
      std::visit(
          [&](auto& s) {
            if constexpr (requires { s.cone; }) s.cone = cone;
          },
          settings);
      for (bool vulkan : {false, true}) {
        if (vulkan && !method.vulkan) continue;
        SCOPED_TRACE(std::string(method.name) + (vulkan ? " on Vulkan" : ""));
        std::vector<float> values[5];
        std::array<ImageView<float>, 5> views;
        for (int c = 0; c < 5; ++c) {
          values[c].assign(std::size_t{kSide} * kSide, -1.0f);
          views[c] = {values[c].data(), kSide, kSide};
        }
        const Outputs outputs{.visibility = views[0],
                              .bent_normal = {views[1], views[2], views[3]},
                              .cone_angle = views[4]};
        const Status status = vulkan ? vulkan_->run(in.field(), settings, outputs, nullptr, {})
                                     : compute(in.field(), settings, outputs);
        ASSERT_TRUE(status.ok()) << status.message();
        EXPECT_NEAR(values[0][kMiddle], 0, 1e-3);
        EXPECT_EQ(values[4][kMiddle], 0);
        EXPECT_NEAR(values[1][kMiddle], 0, 1e-6);
        EXPECT_NEAR(values[2][kMiddle], 0, 1e-6);
        EXPECT_NEAR(values[3][kMiddle], 1, 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace obscura

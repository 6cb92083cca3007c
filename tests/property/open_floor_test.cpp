// An open floor that reaches to the horizon: nothing stands above it, so everything sees all of the
// sky. Its depth grows without bound towards the horizon, within few pixels.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "obscura/obscura.h"
#include "tests/property/synthetic.h"

namespace obscura {
namespace {

// The least visibility of the floor's pixels.
float least(const synthetic::Input& in, const MethodSettings& settings) {
  std::vector<float> v(in.depth.size());
  const Status s = compute(in.field(), settings, {.visibility = {v.data(), in.width, in.height}});
  EXPECT_TRUE(s.ok()) << s.message();
  float result = 1;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (std::isfinite(in.depth[i])) result = std::min(result, v[i]);
  }
  return result;
}

// A floor 1 below the camera, which looks `pitch` down and is turned by `roll`.
synthetic::Input floor_of(double pitch, double roll, bool normals) {
  const int w = 240, h = 136;
  synthetic::Input in =
      synthetic::plane(w, h, Camera::perspective(50 * static_cast<float>(M_PI) / 180, w, h),
                       std::cos(pitch) * std::sin(roll), std::cos(pitch) * std::cos(roll),
                       std::sin(pitch), 1 / std::sin(pitch));
  if (!normals) in.normals.clear();
  return in;
}

TEST(OpenFloor, IsOpenForEveryMethodAtItsDefaults) {
  const synthetic::Input in = floor_of(0.02, 0, false);
  for_each_method([&]<class S>(MethodInfo<S> info, S settings) {
    if constexpr (std::is_same_v<S, ReferenceSettings>) settings.rays = 64;
    // The far field's default matter is as thick as it is wide: near the horizon, where rows of
    // texels are far apart, it hides some of the sky.
    if constexpr (std::is_same_v<S, FarFieldSettings>) {
      EXPECT_GT(least(in, settings), 0.93f) << info.name;
      settings.occluder = Occluder{};
    }
    EXPECT_GT(least(in, settings), 0.99f) << info.name;
  });
}

TEST(OpenFloor, AreaSeesNoFurtherThanThePlane) {
  for (const double pitch : {0.02, 0.3}) {
    for (const double roll : {0.0, 0.7}) {
      for (const bool normals : {false, true}) {
        const synthetic::Input in = floor_of(pitch, roll, normals);
        for (const float radius : {0.05f, 0.2f, 1.0f, 5.0f, 100.0f}) {
          for (const int samples : {1, 4}) {
            AreaSettings s;
            s.falloff.radius = radius;
            s.samples = samples;
            s.blur = false;
            EXPECT_GT(least(in, s), 0.985f)
                << "pitch " << pitch << " roll " << roll << " normals " << normals << " radius "
                << radius << " samples " << samples;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace obscura

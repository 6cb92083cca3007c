// Properties of ambient obscurance from a depth pyramid.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "obscura/obscura.h"
#include "tests/property/synthetic.h"

namespace obscura {
namespace {

std::vector<float> visibility(const synthetic::Input& in, const MipmapSettings& settings) {
  std::vector<float> v(in.depth.size(), -1.0f);
  Outputs outputs;
  outputs.visibility = {v.data(), in.width, in.height};
  const Status s = compute(in.field(), settings, outputs);
  EXPECT_TRUE(s.ok()) << s.message();
  return v;
}

TEST(Mipmap, PlanesThatFaceTheCameraAreOpen) {
  for (DepthPyramid pyramid : {DepthPyramid::kAverage, DepthPyramid::kNearest}) {
    for (bool parallel : {false, true}) {
      const Camera camera =
          parallel ? Camera::orthographic_height(4, 90, 60) : Camera::perspective(1.0f, 90, 60);
      MipmapSettings s;
      s.falloff.radius = std::numeric_limits<float>::infinity();
      s.pyramid = pyramid;
      for (float v : visibility(synthetic::plane(90, 60, camera, 0, 0, 1, 5), s)) {
        EXPECT_NEAR(v, 1, 1e-3);
      }
    }
  }
}

TEST(Mipmap, ExtremesHaveDefinedValues) {
  for (const auto& [w, h] : {std::pair{1, 1}, {40, 1}, {1, 40}, {33, 17}}) {
    for (double scale : {1e-3, 1.0, 1e6}) {
      synthetic::Input in = synthetic::blocks(w, h, Camera::perspective(1.0f, w, h), 5);
      for (float& d : in.depth) d *= static_cast<float>(scale);
      for (float v : visibility(in, {})) EXPECT_TRUE(v >= 0 && v <= 1);
    }
  }
}

TEST(Mipmap, RefusesWrongSettings) {
  Estimator e;
  MipmapSettings s;
  s.directions = 3;
  EXPECT_FALSE(Estimator::create(s, 8, 8, &e).ok());
  s = {};
  s.step_factor = 1;
  EXPECT_FALSE(Estimator::create(s, 8, 8, &e).ok());
}

}  // namespace
}  // namespace obscura

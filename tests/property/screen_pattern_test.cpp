// Directions from point samples on the screen.
#include <gtest/gtest.h>

#include <cmath>

#include "obscura/obscura.h"
#include "tests/property/synthetic.h"

namespace obscura {
namespace {

struct Result {
  Status status;
  std::vector<float> visibility, alone, angle, bent;
};
Result run(const synthetic::Input& in, const DepthField& field) {
  PointSettings s;
  s.pattern = PointPattern::kScreen;
  s.samples = 32;
  s.falloff.radius = 0.5f;
  const std::size_t n = in.depth.size();
  Result r{{},
           std::vector<float>(n),
           std::vector<float>(n),
           std::vector<float>(n),
           std::vector<float>(3 * n)};
  Outputs o;
  o.visibility = {r.alone.data(), in.width, in.height};
  EXPECT_TRUE(compute(field, s, o).ok());
  o.visibility = {r.visibility.data(), in.width, in.height};
  o.cone_angle = {r.angle.data(), in.width, in.height};
  o.bent_normal = VectorView<float>::interleaved(r.bent.data(), in.width, in.height);
  r.status = compute(field, s, o);
  return r;
}

TEST(ScreenPattern, OpenPlanesLookAlongTheirNormals) {
  for (bool orthographic : {false, true}) {
    const Camera camera =
        orthographic ? Camera::orthographic_height(4, 90, 70) : Camera::perspective(1, 90, 70);
    const synthetic::Input in = synthetic::plane(90, 70, camera, 0.48, 0.36, 0.8, 5);
    const Result r = run(in, in.field());
    ASSERT_TRUE(r.status.ok());
    for (std::size_t i = 0; i < in.depth.size(); ++i) {
      ASSERT_NEAR(r.visibility[i], 1, 1e-6);
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(r.bent[3 * i + k], in.normals[3 * i + k], 1e-4);
      ASSERT_GT(r.angle[i], 1.56f);
    }
  }
}

// The lower floor beside a step up on its left: light comes from the right, and the opening
// narrows.
TEST(ScreenPattern, BentNormalsTurnAwayFromOccluders) {
  synthetic::Input in =
      synthetic::plane(64, 64, Camera::orthographic_height(4, 64, 64), 0, 0, 1, 5);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 32; ++x) in.depth[y * 64 + x] = 4.8f;
  }
  const Result r = run(in, in.field());
  ASSERT_TRUE(r.status.ok());
  const std::size_t beside = 32 * 64 + 34, away = 32 * 64 + 60;
  EXPECT_GT(r.bent[3 * beside], 0.15f);
  EXPECT_NEAR(r.bent[3 * beside + 1], 0, 0.1);
  EXPECT_GT(r.bent[3 * beside + 2], 0.7f);
  EXPECT_LT(r.angle[beside], 1.5f);
  EXPECT_NEAR(r.bent[3 * away + 2], 1, 1e-4);
  for (std::size_t i = 0; i < in.depth.size(); ++i) ASSERT_NEAR(r.visibility[i], r.alone[i], 1e-6);
}

TEST(ScreenPattern, DirectionsWithoutNormalsAreRefused) {
  synthetic::Input in = synthetic::plane(16, 16, Camera::perspective(1, 16, 16), 0, 0, 1, 5);
  DepthField field = in.field();
  field.normals = {};
  field.normal_use = NormalUse::kNone;
  EXPECT_EQ(run(in, field).status.code(), StatusCode::kUnsupported);
}

}  // namespace
}  // namespace obscura

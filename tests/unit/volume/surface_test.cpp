#include "obscura/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "hwy/targets.h"

namespace obscura {
namespace {

// A ball of radius 0.6 around the middle of a box of 2 x 2 x 2, as distances, positive in the open.
struct Ball {
  std::array<int, 3> size;
  std::array<float, 3> spacing;
  std::vector<float> distance, values;

  explicit Ball(std::array<int, 3> n = {41, 41, 41}) : size(n) {
    for (int a = 0; a < 3; ++a) spacing[a] = 2.0f / float(n[a] - 1);
    for (int z = 0; z < n[2]; ++z) {
      for (int y = 0; y < n[1]; ++y) {
        for (int x = 0; x < n[0]; ++x) {
          const float r = std::hypot(x * spacing[0] - 1, y * spacing[1] - 1, z * spacing[2] - 1);
          distance.push_back(r - 0.6f);
          values.push_back(7 + 3 * (0.6f - r));  // 7 on the surface, more inside
        }
      }
    }
  }
  SurfaceScene scene() const {
    SurfaceScene s;
    s.volume.data = values.data();
    s.volume.size = size;
    s.volume.spacing = spacing;
    s.isovalue = 7;
    s.distance = {distance.data(), size, spacing};
    return s;
  }
};

SurfaceCamera from_above() {
  SurfaceCamera c;
  c.eye = {1, 1, 5};
  c.orthographic = true;
  c.ortho_height = 2;
  return c;
}

struct Pictures {
  int size;
  std::vector<float> visibility, coverage, depth;
  explicit Pictures(int n)
      : size(n), visibility(n * n, -1.0f), coverage(n * n, -1.0f), depth(n * n, -1.0f) {}
  SurfaceOutputs outputs() {
    return {
        {visibility.data(), size, size}, {coverage.data(), size, size}, {depth.data(), size, size}};
  }
};

Status render(const Ball& ball, const SurfaceCamera& camera, int samples, Pictures* pictures,
              const SurfaceShader& shader = {}, int threads = 2) {
  const auto executor = make_executor(threads);
  RunOptions run;
  run.executor = executor.get();
  return render_surface(ball.scene(), camera, {samples}, shader, pictures->outputs(), run);
}

TEST(Surface, BallHasItsDepthAndNormals) {
  for (const std::array<int, 3>& n : {std::array{41, 41, 41}, {61, 41, 31}}) {
    const Ball ball(n);
    Pictures p(64);
    // Light says how far the point and its normal are from the ball's.
    const SurfaceShader error = [](int, std::span<const SurfacePoint> points,
                                   std::span<float> light) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        float away = 0, radius2 = 0;
        for (int a = 0; a < 3; ++a) {
          const float r = points[i].position[a] - 1;
          radius2 += r * r;
          away = std::max(away, std::abs(points[i].normal[a] - r / 0.6f));
        }
        light[i] = std::max(away, std::abs(std::sqrt(radius2) - 0.6f));
      }
      return Status();
    };
    ASSERT_TRUE(render(ball, from_above(), 1, &p, error).ok());
    int hits = 0;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const double u = (x + 0.5) / 32 - 1, v = (y + 0.5) / 32 - 1, r2 = u * u + v * v;
        const std::size_t i = std::size_t(y * 64 + x);
        if (r2 > 0.62 * 0.62) {
          EXPECT_EQ(p.coverage[i], 0);
          EXPECT_EQ(p.visibility[i], 1);
          EXPECT_EQ(p.depth[i], std::numeric_limits<float>::infinity());
        } else if (r2 < 0.55 * 0.55) {
          ++hits;
          EXPECT_EQ(p.coverage[i], 1);
          EXPECT_NEAR(p.depth[i], 4 - std::sqrt(0.36 - r2), 0.006) << x << " " << y;
          EXPECT_LT(p.visibility[i], 0.02) << x << " " << y;
        }
      }
    }
    EXPECT_GT(hits, 900);
  }
}

TEST(Surface, CoverageIsTheBallsShadow) {
  Pictures p(64);
  ASSERT_TRUE(render(Ball(), from_above(), 16, &p).ok());
  double covered = 0;
  for (float c : p.coverage) covered += c;
  EXPECT_NEAR(covered / (64 * 64), 3.14159265 * 0.36 / 4, 2e-3);
}

TEST(Surface, PerspectiveShowsTheTangentCone) {
  SurfaceCamera camera = from_above();
  camera.orthographic = false;
  camera.eye = {1, 1, 4};
  camera.fov_y = 0.8f;
  Pictures p(64);
  ASSERT_TRUE(render(Ball(), camera, 16, &p).ok());
  double covered = 0;
  for (float c : p.coverage) covered += c;
  const double radius = std::tan(std::asin(0.6 / 3)) / std::tan(0.4);
  EXPECT_NEAR(covered / (64 * 64), 3.14159265 * radius * radius / 4, 2e-3);
}

TEST(Surface, MirroredAxesMirrorThePicture) {
  Ball ball;
  // Something that is not its own mirror image: a bite off one side.
  for (std::size_t i = 0; i < ball.values.size(); ++i) {
    if (i % 41 > 25) {
      ball.values[i] = 5;
      ball.distance[i] = std::max(ball.distance[i], 0.05f * (float(i % 41) - 25.0f));
    }
  }
  SurfaceCamera camera = from_above();
  Pictures plain(32), mirrored(32);
  ASSERT_TRUE(render(ball, camera, 1, &plain).ok());
  camera.right = {-1, 0, 0};
  ASSERT_TRUE(render(ball, camera, 1, &mirrored).ok());
  int different = 0;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      EXPECT_EQ(plain.coverage[y * 32 + x], mirrored.coverage[y * 32 + 31 - x]);
      different += plain.coverage[y * 32 + x] != mirrored.coverage[y * 32 + x];
    }
  }
  EXPECT_GT(different, 10);
}

TEST(Surface, MatterIsCutByTheBorder) {
  // Everything is matter: the picture shows the box's face.
  std::vector<float> values(1000, 1.0f), distance(1000, -1.0f);
  values[0] = 0;
  distance[0] = 0.5f;
  SurfaceScene scene;
  scene.volume.data = values.data();
  scene.volume.size = {10, 10, 10};
  scene.isovalue = 0.5f;
  scene.distance = {distance.data(), {10, 10, 10}, {1, 1, 1}};
  SurfaceCamera camera;
  camera.eye = {4.5f, 4.5f, 30};
  camera.orthographic = true;
  camera.ortho_height = 4;
  Pictures p(8);
  const SurfaceShader up = [](int, std::span<const SurfacePoint> points, std::span<float> light) {
    for (std::size_t i = 0; i < points.size(); ++i) light[i] = points[i].normal[2];
    return Status();
  };
  ASSERT_TRUE(render_surface(scene, camera, {1}, up, p.outputs()).ok());
  for (int i = 0; i < 64; ++i) {
    EXPECT_EQ(p.visibility[i], 1);
    EXPECT_NEAR(p.depth[i], 21, 1e-4);
  }
}

TEST(Surface, TypesNaNAndThinAxes) {
  // A slab one voxel thick along z, seen from above; the right half is NaN, which is open.
  std::vector<float> values(64), distance(64);
  for (int i = 0; i < 64; ++i) {
    const bool open = i % 8 >= 4;
    values[i] = open ? NAN : 1.0f;
    distance[i] = open ? float(i % 8) - 3.0f : -1.0f;
  }
  SurfaceScene scene;
  scene.volume.data = values.data();
  scene.volume.size = {8, 8, 1};
  scene.isovalue = 0.5f;
  scene.distance = {distance.data(), {8, 8, 1}, {1, 1, 1}};
  SurfaceCamera camera;
  camera.eye = {3.5f, 3.5f, 10};
  camera.orthographic = true;
  camera.ortho_height = 7;
  Pictures p(7);
  ASSERT_TRUE(render_surface(scene, camera, {1}, {}, p.outputs()).ok());
  for (int x = 0; x < 7; ++x) EXPECT_EQ(p.coverage[3 * 7 + x], x < 3 ? 1 : 0) << x;
}

TEST(Surface, SameBitsForAnyThreadsAndCloseOnEveryTarget) {
  const Ball ball;
  Pictures first(48);
  ASSERT_TRUE(render(ball, from_above(), 4, &first, {}, 1).ok());
  Pictures two(48);
  ASSERT_TRUE(render(ball, from_above(), 4, &two, {}, 2).ok());
  EXPECT_EQ(first.coverage, two.coverage);
  EXPECT_EQ(first.depth, two.depth);
  for (const std::uint32_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    Pictures other(48);
    EXPECT_TRUE(render(ball, from_above(), 4, &other).ok());
    hwy::SetSupportedTargetsForTest(0);
    int different = 0;
    for (std::size_t i = 0; i < first.depth.size(); ++i) {
      different += first.coverage[i] != other.coverage[i];
      if (first.coverage[i] == 1 && other.coverage[i] == 1) {
        EXPECT_NEAR(first.depth[i], other.depth[i], 1e-4);
      }
    }
    EXPECT_LE(different, 2);
  }
}

TEST(Surface, RefusesBadInput) {
  const Ball ball;
  Pictures p(8);
  auto expect = [&](const SurfaceScene& scene, const SurfaceCamera& camera, int samples,
                    const std::string& part) {
    const Status s = render_surface(scene, camera, {samples}, {}, p.outputs());
    EXPECT_FALSE(s.ok());
    EXPECT_NE(s.message().find(part), std::string::npos) << s.message();
    EXPECT_EQ(p.visibility, std::vector<float>(64, -1.0f));
  };
  SurfaceCamera camera = from_above();
  expect(ball.scene(), camera, 0, "samples_per_pixel");
  SurfaceScene scene = ball.scene();
  scene.isovalue = NAN;
  expect(scene, camera, 1, "isovalue");
  scene = ball.scene();
  scene.distance.size[0] = 40;
  expect(scene, camera, 1, "distance.size");
  scene = ball.scene();
  scene.volume.data = nullptr;
  expect(scene, camera, 1, "null");
  camera.up = camera.right;
  expect(ball.scene(), camera, 1, "right angles");
  camera = from_above();
  camera.eye[1] = NAN;
  expect(ball.scene(), camera, 1, "eye");
  camera = from_above();
  camera.ortho_height = 0;
  expect(ball.scene(), camera, 1, "ortho_height");
  camera.orthographic = false;
  camera.fov_y = 4;
  expect(ball.scene(), camera, 1, "fov_y");
  SurfaceOutputs none;
  EXPECT_FALSE(render_surface(ball.scene(), from_above(), {}, {}, none).ok());
}

TEST(Surface, ShaderFailuresAndCancelling) {
  const Ball ball;
  Pictures p(64);
  const SurfaceShader fails = [](int, std::span<const SurfacePoint>, std::span<float>) {
    return invalid_input("no light");
  };
  EXPECT_EQ(render(ball, from_above(), 1, &p, fails).message(), "no light");
  RunOptions run;
  run.progress = [](double) { return false; };
  EXPECT_EQ(render_surface(ball.scene(), from_above(), {}, {}, p.outputs(), run).code(),
            StatusCode::kCancelled);
}

}  // namespace
}  // namespace obscura

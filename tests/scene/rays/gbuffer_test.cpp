#include "scene/rays/gbuffer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/rays/intervals.h"
#include "scene/rays/solids.h"
#include "scene/scenes/random.h"
#include "scene/scenes/shapes.h"

namespace obscura::tools {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

std::unique_ptr<RayScene> scene_of(Mesh mesh, double size = 1) {
  mesh.scene_size = size;
  std::unique_ptr<RayScene> scene;
  EXPECT_TRUE(RayScene::create(std::move(mesh), &scene).ok());
  return scene;
}

std::vector<Interval> matter_along(const RayScene& scene, Vec3 origin, Vec3 direction,
                                   double sheet = 0.01) {
  std::vector<RayScene::Hit> hits;
  std::vector<Interval> matter;
  scene.intersect_all(origin, direction, &hits);
  find_matter(scene, direction, sheet, &hits, &matter);
  return matter;
}

void expect_intervals(const std::vector<Interval>& matter,
                      std::initializer_list<Interval> expected) {
  ASSERT_EQ(matter.size(), expected.size());
  for (std::size_t i = 0; i < matter.size(); ++i) {
    EXPECT_NEAR(matter[i].front, expected.begin()[i].front, 1e-6) << i;
    EXPECT_NEAR(matter[i].back, expected.begin()[i].back, 1e-6) << i;
  }
}

constexpr Vec3 kAhead{0, 0, -1};

TEST(Intervals, SolidsOneBehindTheOther) {
  Mesh mesh;
  Shapes shapes(&mesh);
  shapes.box({-1, -1, -2}, {1, 1, -1});
  shapes.box({-1, -1, -5}, {1, 1, -4});
  shapes.sphere({0, 0, -8}, 1);
  const auto scene = scene_of(std::move(mesh));
  expect_intervals(matter_along(*scene, {0.3, 0.2, 0}, {0, 0, -2}),
                   {{0.5, 1}, {2, 2.5}, {(8 - std::sqrt(0.87)) / 2, (8 + std::sqrt(0.87)) / 2}});
}

TEST(Intervals, SolidsThatOverlapTouchOrContainEachOtherAreOne) {
  Mesh mesh;
  Shapes shapes(&mesh);
  shapes.box({-1, -1, -3}, {1, 1, -1});
  shapes.box({-2, -1, -4}, {1, 1, -2});          // overlaps
  shapes.box({-1, -1, -5}, {1, 1, -4});          // touches
  shapes.box({-.5, -.5, -2.5}, {.5, .5, -1.5});  // inside
  shapes.sphere({0, 0, -5}, 0.5);
  const auto scene = scene_of(std::move(mesh));
  expect_intervals(matter_along(*scene, {0, 0, 0}, kAhead), {{1, 5.5}});
  expect_intervals(matter_along(*scene, {0.9, 0.9, 0}, kAhead), {{1, 5}});
}

TEST(Intervals, RaysThroughEdgesAndCornersStayBounded) {
  Mesh mesh;
  Shapes(&mesh).box({-1, -1, -2}, {1, 1, -1});
  const auto scene = scene_of(std::move(mesh));
  // The diagonals of the faces, where two triangles meet.
  for (double u : {-0.75, -0.5, 0.0, 0.25, 0.5}) {
    for (double v : {u, -u}) {
      expect_intervals(matter_along(*scene, {u, v, 0}, kAhead), {{1, 2}});
    }
  }
  // Grazing: along a side face, through an edge, through a corner. Any answer is right that holds
  // no matter beyond the box.
  for (Vec3 origin : {Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{-1, 0.3, 0}}) {
    for (const Interval& i : matter_along(*scene, origin, kAhead)) {
      EXPECT_GE(i.front, 1 - 1e-6);
      EXPECT_LE(i.back, 2 + 0.011);
    }
  }
}

TEST(Intervals, SheetsHaveTheThicknessGiven) {
  Mesh mesh;
  const Vec3 near[] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}};
  const Vec3 far[] = {{-1, -1, -2}, {-1, 1, -2}, {1, -1, -2}, {1, 1, -2}};  // seen from behind
  Shapes shapes(&mesh);
  shapes.sheet(near);
  shapes.sheet(far);
  const auto scene = scene_of(std::move(mesh));
  expect_intervals(matter_along(*scene, {0.1, 0.4, 0}, kAhead, 0.25), {{1, 1.25}, {2, 2.25}});
  expect_intervals(matter_along(*scene, {0.1, 0.4, 0}, kAhead, 1.5), {{1, 3.5}});
}

// What share of a ray is matter, and whether a point is: two ways to the volume of many solids.
TEST(Intervals, AgreeWithPointsInRandomSolids) {
  Random random(7);
  Mesh mesh;
  Shapes shapes(&mesh);
  struct Ball {
    Vec3 center;
    double radius;
  };
  std::vector<Ball> balls;
  for (int i = 0; i < 30; ++i) {
    const Vec3 center{random.in(-1, 1), random.in(-1, 1), random.in(-4, -2)};
    const double radius = random.in(0.1, 0.5);
    balls.push_back({center, radius});
    if (i % 2 == 0) {
      shapes.sphere(center, radius);
    } else {
      shapes.ball(
          center, [&](Vec3) { return radius; }, 5);
    }
  }
  const auto scene = scene_of(std::move(mesh));
  int wrong = 0, inside = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 direction{random.in(-0.4, 0.4), random.in(-0.4, 0.4), -1};
    const auto matter = matter_along(*scene, {}, direction);
    for (int k = 0; k < 20; ++k) {
      const double t = random.in(1.5, 4.5);
      bool by_ray = false, by_point = false;
      for (const Interval& m : matter) by_ray |= m.front <= t && t <= m.back;
      for (const Ball& b : balls) by_point |= length(direction * t - b.center) < b.radius;
      wrong += by_ray != by_point;
      inside += by_point;
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_LE(wrong, 20);  // facets of the finer balls
}

TEST(Solids, ComponentsAreJudgedOneByOne) {
  Mesh mesh;
  Shapes shapes(&mesh);
  shapes.box({0, 0, 0}, {1, 1, 1});  // a solid
  shapes.box({2, 0, 0}, {3, 1, 1});  // made open below
  shapes.box({4, 0, 0}, {5, 1, 1});  // turned inside out: a room
  shapes.box({6, 0, 0}, {7, 1, 1});  // one face turned
  shapes.box({1, 1, 1}, {2, 2, 2});  // touches the first in a corner
  const Vec3 leaf[] = {{8, 0, 0}, {9, 0, 0}, {8, 1, 0}}, back[] = {{8, 0, 0}, {8, 1, 0}, {9, 0, 0}};
  shapes.sheet(leaf);
  shapes.sheet(back);
  mesh.triangles.erase(mesh.triangles.begin() + 12);
  for (int i = 23; i < 35; ++i) std::swap(mesh.triangles[i].a, mesh.triangles[i].b);
  std::swap(mesh.triangles[35].a, mesh.triangles[35].b);
  // Corners of their own for each triangle, as in many files.
  Mesh split;
  for (const Mesh::Triangle& t : mesh.triangles) {
    const auto first = std::uint32_t(split.positions.size());
    for (std::uint32_t i : {t.a, t.b, t.c}) split.positions.push_back(mesh.positions[i]);
    split.triangles.push_back({first, first + 1, first + 2});
  }
  find_solids(&split);
  ASSERT_EQ(split.parts.size(), 3u);
  EXPECT_TRUE(split.parts[0].closed);
  EXPECT_EQ(split.parts[0].count, 12u);
  EXPECT_TRUE(split.parts[1].closed);
  EXPECT_EQ(split.parts[1].count, 12u);
  EXPECT_FALSE(split.parts[2].closed);
  EXPECT_EQ(split.triangles.size(), mesh.triangles.size());
  for (int p = 0; p < 2; ++p) {
    EXPECT_NEAR(signed_volume(split, split.parts[p].first, split.parts[p].count), 1, 1e-6);
  }
}

TEST(GBuffer, DepthAndNormalsOfPlaneAndSphereAreExact) {
  Mesh mesh;
  Shapes shapes(&mesh);
  shapes.box({-50, -2, -50}, {50, -1, 50});
  shapes.sphere({0, 0.3, -4}, 1);
  const auto scene = scene_of(std::move(mesh), 2);
  ViewSpec view;
  view.width = 61;
  view.height = 37;
  view.guard_band = {3, 5, 2, 4};
  view.eye = {0, 0, 0};
  view.look_at = {0, 0, -1};
  DepthInput g;
  ASSERT_TRUE(render_gbuffer(*scene, view, {}, *make_executor(), &g).ok());
  ASSERT_EQ(g.width, 69);
  ASSERT_EQ(g.height, 43);
  int ball = 0, floor = 0, sky = 0;
  for (int y = 0; y < g.height; ++y) {
    for (int x = 0; x < g.width; ++x) {
      const int i = y * g.width + x;
      const Vec3 d{(x + 0.5 - g.camera.center_u) * g.camera.scale_x,
                   (g.camera.center_v - y - 0.5) * g.camera.scale_y, -1};
      const Vec3 c{0, 0.3, -4};
      const double a = dot(d, d), b = dot(d, c), root = b * b - a * (dot(c, c) - 1);
      const Vec3 n{g.normal_x[i], g.normal_y[i], g.normal_z[i]};
      if (root > 0) {
        ++ball;
        const double t = (b - std::sqrt(root)) / a;
        EXPECT_NEAR(g.depth[i], t, 1e-6 * t);
        EXPECT_NEAR(length(n - (d * t - c)), 0, 1e-6);
      } else if (d.y < 0 && -1 / d.y < 50) {
        ++floor;
        EXPECT_FLOAT_EQ(g.depth[i], float(-1 / d.y));
        EXPECT_NEAR(length(n - Vec3{0, 1, 0}), 0, 1e-7);
      } else if (d.y > 0) {
        ++sky;
        EXPECT_EQ(g.depth[i], kInf);
        EXPECT_EQ(g.normal_z[i], 1);
      }
    }
  }
  EXPECT_GT(std::min({ball, floor, sky}), 100);
}

TEST(GBuffer, LayersAndBackDepthOfASphere) {
  Mesh mesh;
  Shapes shapes(&mesh);
  shapes.sphere({0, 0, -4}, 1);
  const Vec3 curtain[] = {{-9, -9, -8}, {9, -9, -8}, {-9, 9, -8}, {9, 9, -8}};
  shapes.sheet(curtain);
  const auto scene = scene_of(std::move(mesh), 4);
  for (bool orthographic : {false, true}) {
    ViewSpec view;
    view.width = view.height = 32;
    view.guard_band = {};
    view.eye = {0, 0, 0};
    view.look_at = {0, 0, -1};
    view.orthographic = orthographic;
    view.ortho_height = 3;
    DepthInput g;
    LayerSpec spec{3, true, 0.5};
    ASSERT_TRUE(render_gbuffer(*scene, view, spec, *make_executor(), &g).ok());
    const int middle = 16 * 32 + 16, corner = 0;
    EXPECT_NEAR(g.layers[0].front[middle], 3, 0.01);
    EXPECT_NEAR(g.layers[0].back[middle], 5, 0.01);
    EXPECT_EQ(g.back_depth[middle], g.layers[0].back[middle]);
    EXPECT_FLOAT_EQ(g.layers[1].front[middle], 8);
    EXPECT_EQ(g.layers[2].front[middle], kInf);
    EXPECT_EQ(g.layers[2].back[middle], kInf);
    // The thickness of a sheet is a length along the ray.
    const double a = (0.5 - g.camera.center_u) * g.camera.scale_x;
    const double cosine = orthographic ? 1 : 1 / std::sqrt(1 + 2 * a * a);
    EXPECT_FLOAT_EQ(g.layers[0].front[corner], 8);
    EXPECT_NEAR(g.layers[0].back[corner], 8 + 0.5 * cosine, 1e-5);
    EXPECT_EQ(g.layers[1].front[corner], kInf);
    // 0: half a per cent of the scene size.
    spec.sheet_thickness = 0;
    ASSERT_TRUE(render_gbuffer(*scene, view, spec, *make_executor(), &g).ok());
    EXPECT_NEAR(g.layers[0].back[corner], 8 + 0.02 * cosine, 1e-5);
  }
}

}  // namespace
}  // namespace obscura::tools

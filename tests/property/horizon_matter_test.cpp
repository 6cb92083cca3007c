// Properties of horizons where matter has an end.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "obscura/obscura.h"
#include "tests/property/synthetic.h"

namespace obscura {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
using Values = std::vector<float>;

Values visibility(const DepthField& field, const MethodSettings& settings) {
  const int w = field.visible().width, h = field.visible().height;
  Values v(static_cast<std::size_t>(w) * h, -1.0f);
  const Status s = compute(field, settings, {.visibility = {v.data(), w, h}});
  EXPECT_TRUE(s.ok()) << s.message();
  return v;
}

HorizonSettings dense() {
  HorizonSettings s;
  s.directions = 32;
  s.steps = 64;
  s.interleave = 1;
  s.blur = false;
  return s;
}

TEST(HorizonMatter, TiltedPlanesAreOpen) {
  for (int i = 0; i < 8; ++i) {
    const double tilt = 0.15 * (i / 2);
    Camera camera = Camera::perspective(1.0f, 120, 90);
    if (i % 2) camera = Camera::orthographic_height(4, 120, 90);
    const synthetic::Input in = synthetic::plane(120, 90, camera, std::sin(tilt) * 0.8,
                                                 std::sin(tilt) * 0.6, std::cos(tilt), 10);
    for (const Occluder& occluder :
         {Occluder::of_thickness(0.01f), Occluder::of_thickness(1e6f), Occluder::automatic()}) {
      for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kExponential}) {
        HorizonSettings s{.occluder = occluder};
        s.falloff = {.kind = kind, .radius = 10};
        double sum = 0;
        const Values v = visibility(in.field(), s);
        for (float x : v) sum += x;
        EXPECT_GT(sum / v.size(), 0.99) << tilt << " " << int(occluder.kind);
      }
    }
  }
}

// A thin plate before a wall, both facing the camera: light passes behind the plate.
TEST(HorizonMatter, LightPassesBehindThinMatter) {
  synthetic::Input in =
      synthetic::plane(160, 120, Camera::perspective(1.0f, 160, 120), 0, 0, 1, 10);
  in.normals.clear();
  Values back(in.depth.size(), 10.1f);
  for (int y = 40; y < 80; ++y) {
    for (int x = 60; x < 100; ++x) {
      in.depth[y * 160 + x] = 5;
      back[y * 160 + x] = 5.1f;
    }
  }
  DepthField field = in.field();
  field.back_depth = {back.data(), 160, 120};
  HorizonSettings s = dense();
  s.falloff.radius = kInf;
  const std::size_t beside = 60 * 160 + 55;  // on the wall, five pixels from the plate's outline
  const auto at = [&](const Occluder& occluder) {
    s.occluder = occluder;
    return visibility(field, s)[beside];
  };
  EXPECT_LT(at(Occluder::solid()), 0.7f);
  const float given = at(Occluder::back_depth());
  EXPECT_GT(given, 0.85f);
  EXPECT_NEAR(at(Occluder::of_thickness(0.1f)), given, 0.01f);
  EXPECT_EQ(at(Occluder::automatic()), given);
}

// Posts of a few pixels before a wall, at ten distances from it: what rays through the same matter
// see, on the wall and behind the post.
TEST(HorizonMatter, PostsBeforeAWallAgreeWithRays) {
  constexpr int kWidth = 96, kHeight = 60;
  for (int k = 0; k < 10; ++k) {
    // Closer to the wall than six footprints of a pixel the two are one surface.
    const float depth = 8.5f - 0.6f * static_cast<float>(k);
    synthetic::Input in =
        synthetic::plane(kWidth, kHeight, Camera::perspective(1.0f, kWidth, kHeight), 0, 0, 1, 10);
    Values back(in.depth.size(), 12.0f);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 45; x < 50; ++x) {
        in.depth[y * kWidth + x] = depth;
        back[y * kWidth + x] = depth + 0.3f;
      }
    }
    DepthField field = in.field();
    field.back_depth = {back.data(), kWidth, kHeight};
    HorizonSettings s = dense();
    s.falloff.radius = 1.5f;
    s.occluder = Occluder::back_depth();
    ReferenceSettings rays{.occluder = Occluder::back_depth()};
    rays.falloff = s.falloff;
    const Values v = visibility(field, s), truth = visibility(field, rays);
    double wall = 0, near_post = 0;
    int walls = 0, near_posts = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (in.depth[i] != 10) continue;
      const double difference = v[i] - truth[i];
      const int x = static_cast<int>(i % kWidth);
      wall += std::abs(difference);
      ++walls;
      if (x < 40 || x >= 55) continue;
      near_post += difference;
      ++near_posts;
    }
    EXPECT_LT(wall / walls, 0.02) << depth;
    // No halo: the wall beside the post is as bright as rays say.
    EXPECT_NEAR(near_post / near_posts, 0, 0.02) << depth;
  }
}

// Matter without end is solid, seen by sectors in place of one horizon.
TEST(HorizonMatter, EndlessThicknessIsSolid) {
  const synthetic::Input in = synthetic::blocks(96, 64, Camera::perspective(1.0f, 96, 64), 4);
  for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kExponential}) {
    HorizonSettings s = dense();
    s.falloff = {.kind = kind, .radius = kind == FalloffKind::kConstant ? kInf : 0.4f};
    s.occluder = Occluder::solid();
    const Values solid = visibility(in.field(), s);
    s.occluder = Occluder::of_thickness(1e6f);
    const Values thick = visibility(in.field(), s);
    double sum = 0;
    for (std::size_t i = 0; i < solid.size(); ++i) sum += std::abs(solid[i] - thick[i]);
    EXPECT_LT(sum / solid.size(), 0.02) << enum_name(kind);
  }
}

TEST(HorizonMatter, DirectionsAreMirroredWithTheImage) {
  synthetic::Input in = synthetic::blocks(90, 50, Camera::perspective(1.0f, 90, 50), 3);
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 45; ++x) {
      in.depth[y * 90 + 89 - x] = in.depth[y * 90 + x];
    }
  }
  in.normals.clear();
  HorizonSettings s = dense();
  s.occluder = Occluder::of_thickness(0.3f);
  s.falloff.radius = 0.7f;
  Values v[4];
  ImageView<float> views[4];
  for (int c = 0; c < 4; ++c) {
    v[c].resize(90 * 50);
    views[c] = {v[c].data(), 90, 50};
  }
  ASSERT_TRUE(compute(in.field(), s,
                      {.visibility = views[0], .bent_normal = {views[1], views[2], views[3]}})
                  .ok());
  double difference[4] = {};
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 90; ++x) {
      for (int c = 0; c < 4; ++c) {
        const float sign = c == 1 ? -1.0f : 1.0f;
        difference[c] += std::abs(v[c][y * 90 + x] - sign * v[c][y * 90 + 89 - x]) / (90 * 50);
      }
    }
  }
  for (double d : difference) EXPECT_LT(d, 0.02);
}

TEST(HorizonMatter, WhatItDoesNotTakeIsRefused) {
  const synthetic::Input in = synthetic::blocks(16, 16, Camera::perspective(1.0f, 16, 16), 4);
  Values v(16 * 16);
  const Outputs outputs{.visibility = {v.data(), 16, 16}};
  const auto message = [&](const HorizonSettings& s) {
    return compute(in.field(), s, outputs).message();
  };
  EXPECT_NE(message({.occluder = Occluder::of_layers(2)}).find("auto, solid, thickness"),
            std::string::npos);
  EXPECT_NE(message({.occluder = Occluder::back_depth()}).find("back_depth is missing"),
            std::string::npos);
  HorizonSettings classic{.occluder = Occluder::of_thickness(1)};
  classic.variant = HorizonVariant::kClassic;
  EXPECT_NE(message(classic).find("solid or auto"), std::string::npos);
  classic.occluder = Occluder::automatic();
  EXPECT_EQ(message(classic), "");
}

}  // namespace
}  // namespace obscura

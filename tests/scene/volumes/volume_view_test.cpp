#include "scene/volumes/volume_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/volumes/load_volume.h"
#include "scene/volumes/volume_picture.h"

namespace obscura::tools {
namespace {

// A volume and its distances.
struct Scene {
  VolumeImage image;
  std::vector<float> values;
  GridView<float> distance;

  explicit Scene(const std::string& spec) {
    EXPECT_TRUE(load_volume(spec, {}, &image).ok());
    values.resize(std::size_t(image.voxels()));
    distance = {values.data(), image.size, image.view().spacing};
    EXPECT_TRUE(sweep_distance(image.view(), {}, distance).ok());
  }
};

// The widest that the matter's voxels reach from the middle of the picture, of half its side.
struct Reach {
  double least[2] = {1e9, 1e9}, most[2] = {-1e9, -1e9};
  double widest() const { return 0.5 * std::max(most[0] - least[0], most[1] - least[1]); }
};

Reach reach_of(const Scene& s, const SurfaceCamera& c, double aspect) {
  Reach reach;
  const auto h = s.image.spacing();
  std::size_t i = 0;
  for (int z = 0; z < s.image.size[2]; ++z) {
    for (int y = 0; y < s.image.size[1]; ++y) {
      for (int x = 0; x < s.image.size[0]; ++x, ++i) {
        if (s.values[i] > 0) continue;
        const double p[3] = {x * h[0] - c.eye[0], y * h[1] - c.eye[1], z * h[2] - c.eye[2]};
        double u = 0, v = 0, w = 0;
        for (int a = 0; a < 3; ++a) {
          u += p[a] * c.right[a];
          v += p[a] * c.up[a];
          w += p[a] * c.forward[a];
        }
        EXPECT_GT(w, 0);
        const double half = c.orthographic ? c.ortho_height / 2.0 : w * std::tan(c.fov_y / 2);
        const double at[2] = {u / (half * aspect), v / half};
        for (int k = 0; k < 2; ++k) {
          reach.least[k] = std::min(reach.least[k], at[k]);
          reach.most[k] = std::max(reach.most[k], at[k]);
        }
      }
    }
  }
  return reach;
}

// The matter touches the frame of 84 % on both sides of one axis, but for half a voxel of room.
TEST(VolumeView, FillsThePicture) {
  for (const char* spec : {"volume:cloud?size=40", "volume:vessels?size=40", "volume:sphere"}) {
    const Scene s(spec);
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      for (const ImageSize size : {ImageSize{100, 100}, ImageSize{200, 100}, ImageSize{90, 160}}) {
        VolumeViewOptions options;
        options.size = size;
        options.camera = projection;
        SurfaceCamera camera;
        ASSERT_TRUE(place_camera(s.image, s.distance, options, &camera).ok());
        const Reach r = reach_of(s, camera, double(size.width) / size.height);
        for (int k = 0; k < 2; ++k) {
          EXPECT_LE(r.most[k], 0.841) << spec;
          EXPECT_GE(r.least[k], -0.841) << spec;
        }
        EXPECT_GE(r.widest(), 0.78) << spec;
      }
    }
  }
}

// A point to look at stays in the middle, and everything is in the picture all the same.
TEST(VolumeView, LooksAtThePoint) {
  const Scene s("volume:cloud?size=40");
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
    VolumeViewOptions options;
    options.camera = projection;
    options.look_at = Vec3{0.8, 0.3, 0.6};
    SurfaceCamera camera;
    ASSERT_TRUE(place_camera(s.image, s.distance, options, &camera).ok());
    const Double3 target = s.image.to_grid({0.8, 0.3, 0.6});
    double u = 0, v = 0;
    for (int a = 0; a < 3; ++a) {
      u += (target[a] - camera.eye[a]) * camera.right[a];
      v += (target[a] - camera.eye[a]) * camera.up[a];
    }
    EXPECT_NEAR(u, 0, 1e-4);
    EXPECT_NEAR(v, 0, 1e-4);
    const Reach r = reach_of(s, camera, 1);
    for (int k = 0; k < 2; ++k) {
      EXPECT_LE(r.most[k], 0.841);
      EXPECT_GE(r.least[k], -0.841);
    }
  }
}

// surface * light^(1/gamma), the background where no ray hits, and half of each in between.
TEST(VolumePicture, ColoursOfKnownLight) {
  Image light(4, 1), coverage(4, 1);
  light.add("Y") = {1, 1, 0.25f, 0.625f};
  coverage.add("Y") = {0, 1, 1, 0.5f};
  const PictureColours colours{{0.8f, 0.4f, 1}, {0.1f, 0.2f, 0}};
  const Image p = picture_of_light(light, coverage, colours, 2);
  ASSERT_EQ(p.channels.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    const auto& v = p.channels[k].values;
    const double s = colours.surface[k], b = colours.background[k];
    EXPECT_NEAR(v[0], b, 1e-6);
    EXPECT_NEAR(v[1], s, 1e-6);
    EXPECT_NEAR(v[2], s / 2, 1e-6);
    // Half a pixel of light 0.25, half of background: (0.5 * 0.25 s^2 + 0.5 b^2)^(1/2).
    EXPECT_NEAR(v[3], std::sqrt(0.125 * s * s + 0.5 * b * b), 1e-6);
  }
}

}  // namespace
}  // namespace obscura::tools

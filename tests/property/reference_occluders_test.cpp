#include <gtest/gtest.h>

#include "tests/property/reference_scenes.h"

namespace obscura {
namespace {

using reference_scenes::Vec;
constexpr float kInf = std::numeric_limits<float>::infinity();

// A slab that floats over a wall which faces the camera, in layers: the slab has matter from depth
// 3 to 3.2 on a rectangle of texels, the wall from 4 to 4.5 everywhere.
struct FloatingSlab {
  static constexpr int kSize = 64, kX0 = 26, kX1 = 39, kY0 = 24, kY1 = 45;
  static constexpr float kFront = 3, kBack = 3.2f, kWall = 4;
  Camera camera;
  std::vector<float> depth, back, second, second_back;

  explicit FloatingSlab(bool orthographic)
      : camera(orthographic ? Camera::orthographic_height(4, kSize, kSize, {})
                            : Camera::perspective(0.9f, kSize, kSize, {})) {
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const bool slab = on_slab(x, y);
        depth.push_back(slab ? kFront : kWall);
        back.push_back(slab ? kBack : 4.5f);
        second.push_back(slab ? kWall : kInf);
        second_back.push_back(slab ? 4.5f : kInf);
      }
    }
  }
  static bool on_slab(int x, int y) { return x >= kX0 && x < kX1 && y >= kY0 && y < kY1; }

  Vec point(double u, double v, double z) const {
    const double unit = camera.orthographic ? 1 : z;
    return {(u - camera.center_u) * camera.scale_x * unit,
            (camera.center_v - v) * camera.scale_y * unit, -z};
  }

  // Of the wall's point at pixel (x, y), with rays from `offset` pixels in front of it: less the
  // form factors of those faces of the slab that are turned to it.
  double visibility(int x, int y, double offset) const {
    Vec p = point(x + 0.5, y + 0.5, kWall);
    p.z += offset * camera.scale_x * (camera.orthographic ? 1.0 : kWall);
    const Vec n{0, 0, 1};
    auto corner = [&](int i) {
      return point(i & 1 ? kX1 : kX0, i & 2 ? kY1 : kY0, i & 4 ? kBack : kFront);
    };
    Vec middle;
    for (int i = 0; i < 8; ++i) middle = middle + corner(i) * 0.125;
    double open = 1;
    const int faces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                             {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    for (const auto& f : faces) {
      const std::vector<Vec> face = {corner(f[0]), corner(f[1]), corner(f[2]), corner(f[3])};
      Vec outward = cross(face[1] - face[0], face[2] - face[0]);
      if (dot(outward, face[0] - middle) < 0) outward = outward * -1;
      if (dot(outward, p - face[0]) > 0) open -= reference_scenes::form_factor(p, n, face);
    }
    return open;
  }
};

// The three occluders that have a back see the same slab, whose visibility is known; a solid one
// fills the room behind it.
TEST(ReferenceOccluders, FloatingSlab) {
  for (const bool orthographic : {true, false}) {
    const FloatingSlab slab(orthographic);
    constexpr int kSize = FloatingSlab::kSize;
    auto view = [&](const std::vector<float>& v) {
      return ImageView<const float>(v.data(), kSize, kSize);
    };
    const DepthLayer layers[] = {{view(slab.depth), view(slab.back)},
                                 {view(slab.second), view(slab.second_back)}};
    DepthField field;
    field.depth = view(slab.depth);
    field.camera = slab.camera;
    field.back_depth = view(slab.back);
    field.layers = layers;
    const std::vector<float> facing(3 * kSize * kSize, 0);
    std::vector<float> normals = facing;
    for (std::size_t i = 2; i < normals.size(); i += 3) normals[i] = 1;
    field.normals = VectorView<const float>::interleaved(normals.data(), kSize, kSize);

    std::vector<float> solid;
    for (const Occluder& occluder :
         {Occluder::solid(), Occluder::back_depth(), Occluder::of_layers(2), Occluder::of_layers(1),
          Occluder::of_thickness(0.2f)}) {
      // A thickness along the view ray is not flat in perspective.
      if (!orthographic && occluder.kind == OccluderKind::kThickness) continue;
      SCOPED_TRACE(SettingText<Occluder>::write(occluder));
      ReferenceSettings s{.occluder = Occluder::solid()};
      s.falloff.radius = kInf;
      s.occluder = occluder;
      s.rays = 4096;
      s.every = 7;
      s.offset_px = 0.5f;
      std::vector<float> visibility(kSize * kSize);
      ASSERT_TRUE(compute(field, s, {.visibility = {visibility.data(), kSize, kSize}}).ok());
      if (solid.empty()) solid = visibility;
      double bias = 0, square = 0, darker = 0;
      int pixels = 0;
      for (int y = 3; y < kSize; y += 7) {
        for (int x = 3; x < kSize; x += 7) {
          const std::size_t i = static_cast<std::size_t>(y) * kSize + x;
          if (FloatingSlab::on_slab(x, y)) {
            EXPECT_NEAR(visibility[i], 1, 1e-4);
            continue;
          }
          const double d = visibility[i] - slab.visibility(x, y, s.offset_px);
          bias += d;
          square += d * d;
          darker += visibility[i] - solid[i];
          ++pixels;
        }
      }
      if (occluder.kind == OccluderKind::kSolid) {
        EXPECT_GT(std::abs(bias / pixels), 0.004);  // another truth: the checker sees it
        continue;
      }
      EXPECT_LE(std::abs(bias / pixels), reference_scenes::kBias);
      EXPECT_LE(std::sqrt(square / pixels), reference_scenes::kRms);
      EXPECT_GT(darker / pixels, 0.004);
    }
  }
}

// Matter that starts where it ends, and texels without any, block nothing.
TEST(ReferenceOccluders, MatterWithoutExtentBlocksNothing) {
  const FloatingSlab slab(false);
  constexpr int kSize = FloatingSlab::kSize;
  DepthField field;
  field.depth = {slab.depth.data(), kSize, kSize};
  field.back_depth = field.depth;
  field.camera = slab.camera;
  ReferenceSettings s{.occluder = Occluder::solid()};
  s.occluder = Occluder::back_depth();
  s.rays = 64;
  std::vector<float> visibility(kSize * kSize);
  ASSERT_TRUE(compute(field, s, {.visibility = {visibility.data(), kSize, kSize}}).ok());
  for (const float v : visibility) EXPECT_EQ(v, 1);
}

// Rays that leave the image end where the setting says. Seen in parallel from above, every ray from
// a plane leaves through the image's side, d / sin(theta) away; the nearest side is at d = 1.
TEST(ReferenceOccluders, BeyondTheBorder) {
  constexpr int kSize = 64;
  const std::vector<float> depth(kSize * kSize, 4);
  DepthField field;
  field.depth = {depth.data(), kSize, kSize};
  field.camera = Camera::orthographic_height(2.0f * kSize / (kSize - 1), kSize, kSize, {});
  auto middle = [&](float beyond, FalloffKind kind, float radius) {
    ReferenceSettings s{.occluder = Occluder::solid()};
    s.falloff = {.kind = kind, .radius = radius};
    s.beyond_border = beyond;
    s.rays = 4096;
    s.every = kSize;  // one pixel, half a pixel from the middle
    std::vector<float> visibility(kSize * kSize);
    EXPECT_TRUE(compute(field, s, {.visibility = {visibility.data(), kSize, kSize}}).ok());
    return visibility[kSize / 2 * kSize + kSize / 2];
  };
  EXPECT_NEAR(middle(0, FalloffKind::kExponential, kInf), 1, 1e-4);
  EXPECT_NEAR(middle(0.5f, FalloffKind::kExponential, kInf), 0, 1e-4);
  EXPECT_NEAR(middle(0.5f, FalloffKind::kConstant, 1.4f), 1, 1e-3);
  // Blocked where a(phi) / sin(theta) + 1/2 <= R, with a the distance of the square's side at
  // azimuth phi: the share max(0, 1 - (a / (R - 1/2))^2) of the cosine-weighted hemisphere.
  double expected = 1;
  constexpr int kSteps = 4096;
  const double step = 1.0 / (kSize - 1);  // half a pixel
  for (int i = 0; i < kSteps; ++i) {
    const double phi = (i + 0.5) * 2 * std::numbers::pi / kSteps;
    const double c = std::cos(phi), v = std::sin(phi);
    // The middle pixel is right of and below the middle.
    const double to_x = (c > 0 ? 1 - step : 1 + step) / std::abs(c);
    const double to_y = (v > 0 ? 1 + step : 1 - step) / std::abs(v);
    const double a = std::min(to_x, to_y) / 1.3;
    expected -= std::max(0.0, 1 - a * a) / kSteps;
  }
  EXPECT_NEAR(middle(0.5f, FalloffKind::kConstant, 1.8f), expected, 3e-3);
}

}  // namespace
}  // namespace obscura

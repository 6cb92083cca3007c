#include <gtest/gtest.h>

#include "tests/property/reference_scenes.h"

namespace obscura {
namespace {

using reference_scenes::agrees;
using reference_scenes::Difference;
using reference_scenes::Scene;
using reference_scenes::Vec;

ReferenceSettings endless(int rays, int every) {
  ReferenceSettings s{.occluder = Occluder::solid()};
  s.falloff.radius = std::numeric_limits<float>::infinity();
  s.rays = rays;
  s.every = every;
  return s;
}

Difference difference(const Scene& scene, const ReferenceSettings& settings) {
  Difference d;
  const Status s = compare(scene, settings, &d);
  EXPECT_TRUE(s.ok()) << s.message();
  return d;
}

#define EXPECT_AGREES(d) \
  EXPECT_TRUE(agrees(d)) << (d).pixels << " pixels, bias " << (d).bias << ", rms " << (d).rms

// An upright V with this opening, its edge on the middle column of texel centres.
Scene groove(double degrees) {
  const double half = degrees / 2 * std::numbers::pi / 180;
  const GuardBand guard = GuardBand::symmetric(12, 10);
  const int width = 121, height = 91;
  const Camera camera = Camera::perspective(0.9f, width - 24, height - 20, guard);
  const Vec right{-std::cos(half), 0, std::sin(half)}, left{std::cos(half), 0, std::sin(half)};
  const double offset = -3 * std::sin(half);  // the edge is 3 in front of the camera
  return reference_scenes::room(width, height, camera, guard, {right, left}, {offset, offset});
}

Scene corner() {
  const GuardBand guard = GuardBand::symmetric(20, 20);
  const Camera camera = Camera::perspective(1.0f, 121, 121, guard);
  // Three mutually perpendicular walls around the view axis, turned so that no edge is on the grid.
  const double c = std::cos(0.3), s = std::sin(0.3), k = 1 / std::sqrt(3.0);
  std::vector<Vec> normals;
  for (int i = 0; i < 3; ++i) {
    const double angle = i * 2 * std::numbers::pi / 3;
    const double x = std::cos(angle) * std::sqrt(2.0 / 3), y = std::sin(angle) * std::sqrt(2.0 / 3);
    normals.push_back({c * x - s * y, s * x + c * y, k});
  }
  return reference_scenes::room(161, 161, camera, guard, normals, {-5 * k, -5 * k, -5 * k});
}

Scene bump(int size) {
  const double r = 0.25;
  auto height = [=](double x, double y, Vec* normal) {
    const double square = r * r - x * x - y * y;
    if (square <= 0) return 0.0;
    *normal = {x / r, y / r, std::sqrt(square) / r};
    return std::sqrt(square);
  };
  auto truth = [=](double x, double y) {
    const double h = std::sqrt(x * x + y * y) / r;
    if (h < 1.2) return std::nan("");
    const double q = std::sqrt(h * h - 1);
    return 1 - (std::atan(1 / q) - q / (h * h)) / std::numbers::pi;
  };
  return reference_scenes::from_above(size, GuardBand::symmetric(size / 5, size / 5), height,
                                      truth);
}

Scene bowl(double cap) {
  const double rim = 0.9, radius = rim / std::sqrt(cap * (2 - cap));
  auto height = [=](double x, double y, Vec* normal) {
    const double square = x * x + y * y;
    if (square >= rim * rim) return 0.0;
    const double z = -std::sqrt(radius * radius - square);
    *normal = {-x / radius, -y / radius, -z / radius};
    return z + radius * (1 - cap);
  };
  auto truth = [=](double x, double y) {
    return x * x + y * y < 0.8 * rim * rim ? 1 - cap / 2 : std::nan("");
  };
  // The surface meets the rim's plane half a pixel too far out on average: small pixels.
  return reference_scenes::from_above(769, GuardBand::symmetric(30, 30), height, truth);
}

TEST(ReferenceClosedForms, Groove) {
  for (const double degrees : {60.0, 90.0, 120.0, 150.0}) {
    SCOPED_TRACE(degrees);
    EXPECT_AGREES(difference(groove(degrees), endless(4096, 12)));
  }
}

TEST(ReferenceClosedForms, Corner) { EXPECT_AGREES(difference(corner(), endless(4096, 13))); }

TEST(ReferenceClosedForms, Bump) { EXPECT_AGREES(difference(bump(321), endless(4096, 27))); }

TEST(ReferenceClosedForms, Bowl) {
  for (const double cap : {0.3, 0.6}) {
    SCOPED_TRACE(cap);
    EXPECT_AGREES(difference(bowl(cap), endless(4096, 93)));
  }
}

// The checker must be able to fail: a reference whose rays follow another cosine, and one whose
// normals are two degrees off.
TEST(ReferenceClosedForms, WrongCosineIsCaught) {
  Scene scene = groove(90);
  ReferenceSettings wrong = endless(4096, 12);
  wrong.weighting = RayWeighting::kUniform;
  EXPECT_FALSE(agrees(difference(scene, wrong)));

  for (std::size_t i = 0; i < scene.input.normals.size(); i += 3) {
    float* n = &scene.input.normals[i];
    const Vec tilted = reference_scenes::unit({n[0] + 0.035 * n[2], n[1], n[2] - 0.035 * n[0]});
    n[0] = static_cast<float>(tilted.x);
    n[2] = static_cast<float>(tilted.z);
  }
  EXPECT_FALSE(agrees(difference(scene, endless(4096, 12))));
}

// Planes of any tilt, near edge-on too, under any camera see everything. Normals from depth.
TEST(ReferenceClosedForms, PlanesAreOpen) {
  Random random(5);
  for (int i = 0; i < 12; ++i) {
    const bool orthographic = i % 2 != 0;
    const Camera camera = synthetic::random_camera(64, 48, orthographic, &random);
    const double angle = 6.2831853 * random.uniform(), tilt = 0.15 + 0.85 * random.uniform();
    const double flat = std::sqrt(1 - tilt * tilt);
    synthetic::Input input =
        synthetic::plane(64, 48, camera, flat * std::cos(angle), flat * std::sin(angle), tilt, 5);
    input.normals.clear();
    std::vector<float> visibility(64 * 48);
    ReferenceSettings s = endless(256, 5);
    ASSERT_TRUE(compute(input.field(), s, {.visibility = {visibility.data(), 64, 48}}).ok());
    // A plane that passes behind the camera has a silhouette against the background; the normals
    // there come from one side only.
    for (int y = 3; y < 45; ++y) {
      for (int x = 3; x < 61; ++x) {
        const bool edge = std::isinf(input.depth[(y - 1) * 64 + x - 1]) ||
                          std::isinf(input.depth[(y + 1) * 64 + x + 1]);
        const float v = visibility[y * 64 + x];
        if (edge || std::isnan(v)) continue;
        EXPECT_GT(v, 0.9999f) << i << " (" << x << ", " << y << ")";
      }
    }
  }
}

}  // namespace
}  // namespace obscura

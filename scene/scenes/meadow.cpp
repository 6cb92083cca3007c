#include <numbers>

#include "scene/scenes/scene.h"
#include "scene/scenes/shapes.h"

// Rolling ground with grass, rocks and trees against the sky: many thin things and few planes.

namespace obscura::tools {
namespace {

constexpr double kPi = std::numbers::pi;

struct MeadowSettings {
  int blades = 26000;
  int rocks = 14;
  int trees = 4;
};
template <FieldsOf<MeadowSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.blades, Field{"blades", "", closed(0, 1e6), "Blades of grass."});
  v(s.rocks, Field{"rocks", "", closed(0, 1000), "Rocks."});
  v(s.trees, Field{"trees", "", closed(0, 50), "Trees."});
}

constexpr double kHalf = 14;  // half the side of the ground
constexpr double kEyeZ = 9;   // where the default camera stands

// Smooth noise in [-1, 1] on a lattice of unit cells.
double noise(std::uint64_t seed, Vec3 p) {
  auto value = [&](double x, double y, double z) {
    const auto i = [](double v) { return std::uint64_t(std::int64_t(v)); };
    Random r(seed ^ (i(x) * 0x8DA6B343u) ^ (i(y) * 0xD8163841u) ^ (i(z) * 0xCB1AB31Fu));
    return r.in(-1, 1);
  };
  const Vec3 c{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  auto fade = [](double t) { return t * t * (3 - 2 * t); };
  const double fx = fade(p.x - c.x), fy = fade(p.y - c.y), fz = fade(p.z - c.z);
  double sum = 0;
  for (int k = 0; k < 8; ++k) {
    const int dx = k & 1, dy = k >> 1 & 1, dz = k >> 2;
    sum += (dx ? fx : 1 - fx) * (dy ? fy : 1 - fy) * (dz ? fz : 1 - fz) *
           value(c.x + dx, c.y + dy, c.z + dz);
  }
  return sum;
}

class Meadow {
 public:
  Meadow(const MeadowSettings& settings, std::uint64_t seed, Mesh* mesh)
      : s_(settings), seed_(seed), random_(seed), shapes_(mesh) {}

  double height(double x, double z) const {
    const double hills = 0.9 * noise(seed_, {x * 0.13, 0.5, z * 0.13}) +
                         0.22 * noise(seed_ + 1, {x * 0.45, 0.5, z * 0.45}) +
                         0.05 * noise(seed_ + 2, {x * 1.7, 0.5, z * 1.7});
    const double away = std::max(0.0, -z / kHalf);
    return hills + 1.3 * away * away;  // rises towards the horizon
  }

  void build() {
    shapes_.terrain({-kHalf, 0, -kHalf}, {kHalf, 0, kHalf}, 160, 160, -3,
                    [&](double x, double z) { return height(x, z); });
    for (int i = 0; i < s_.rocks; ++i) rock(i);
    for (int i = 0; i < s_.trees; ++i) tree(i);
    for (int i = 0; i < s_.blades; ++i) blade();
  }

 private:
  Vec3 on_ground(double x, double z) const { return {x, height(x, z), z}; }

  void rock(int index) {
    // One is in the foreground, the others are at random places.
    const double x = index == 0 ? 1.6 : random_.in(-7, 7);
    const double z = index == 0 ? kEyeZ - 4.6 : kEyeZ - 4 - 11 * random_.unit();
    const double size = index == 0 ? 0.62 : 0.12 + 0.5 * random_.unit() * random_.unit();
    const std::uint64_t seed = random_.bits();
    const Vec3 squash{random_.in(0.9, 1.3), random_.in(0.6, 0.85), random_.in(0.8, 1.2)};
    auto radius = [&](Vec3 w) {
      const double lumps = 0.28 * noise(seed, w * 1.7 + Vec3{9, 9, 9}) +
                           0.1 * noise(seed + 1, w * 4.0 + Vec3{9, 9, 9}) +
                           0.03 * noise(seed + 2, w * 11.0 + Vec3{9, 9, 9});
      return size * (1 + lumps) *
             std::abs(dot(w, Vec3{w.x * squash.x, w.y * squash.y, w.z * squash.z}));
    };
    shapes_.ball(on_ground(x, z) + Vec3{0, 0.25 * size, 0}, radius, size > 0.3 ? 5 : 4);
  }

  // A limb that tapers, bends a little and ends in finer ones; the finest carry leaves.
  void limb(Vec3 from, Vec3 direction, double reach, double radius, int level) {
    constexpr int kPoints = 5;
    Vec3 path[kPoints];
    double radii[kPoints];
    Vec3 heading = direction;
    path[0] = from;
    radii[0] = radius;
    for (int i = 1; i < kPoints; ++i) {
      const double sway = level == 0 ? 0.08 : 0.2;
      heading = normalize(heading + Vec3{random_.in(-sway, sway), random_.in(-0.05, 0.15),
                                         random_.in(-sway, sway)});
      path[i] = path[i - 1] + heading * (reach / (kPoints - 1));
      radii[i] = radius * (1 - 0.5 * i / (kPoints - 1));
    }
    shapes_.tube(path, radii, level == 0 ? 14 : level == 1 ? 8 : 5);
    if (level == 3) {
      for (int i = 0; i < 9; ++i) leaf(path[1 + i % (kPoints - 1)], heading);
      return;
    }
    const int children = level == 0 ? 7 : 4;
    const double turn = random_.in(0, 2 * kPi);
    for (int i = 0; i < children; ++i) {
      const int at = level == 0 ? 2 + i % 3 : 1 + i % 4;
      const Frame f = Frame::around(heading);
      const double angle = turn + 2.4 * i, open = random_.in(0.55, 1.0);
      const Vec3 out = f.x * std::cos(angle) + f.y * std::sin(angle);
      limb(path[at], normalize(heading * std::cos(open) + out * std::sin(open)),
           reach * random_.in(0.5, 0.68), radii[at] * 0.6, level + 1);
    }
  }

  void leaf(Vec3 at, Vec3 heading) {
    const Vec3 along =
        normalize(heading + Vec3{random_.in(-1, 1), random_.in(-1, 0.6), random_.in(-1, 1)});
    const Vec3 across = normalize(cross(along, {random_.in(-1, 1), 1, random_.in(-1, 1)}));
    const double size = random_.in(0.09, 0.17);
    const Vec3 points[] = {at, at + along * (0.5 * size) - across * (0.3 * size),
                           at + along * (0.5 * size) + across * (0.3 * size), at + along * size};
    shapes_.sheet(points);
  }

  void tree(int index) {
    const double places[][2] = {{-3.4, 0.8}, {3.9, -2.6}, {0.4, -7.5}, {-7.5, -6}};
    const double x = index < 4 ? places[index][0] : random_.in(-12, 12);
    const double z = index < 4 ? places[index][1] : random_.in(-12, 3);
    const double size = random_.in(0.85, 1.15);
    limb(on_ground(x, z) - Vec3{0, 0.1, 0}, {0, 1, 0}, 2.6 * size, 0.19 * size, 0);
  }

  // Nearer to the camera there are more of them, as seen from there.
  void blade() {
    const double distance = 1.2 + 13 * std::pow(random_.unit(), 1.3);
    const double angle = random_.in(-0.95, 0.95);
    const double x = distance * std::sin(angle), z = kEyeZ - distance * std::cos(angle);
    if (std::abs(x) > kHalf || std::abs(z) > kHalf) return;
    // Tufts: noise thins the grass out.
    if (noise(seed_ + 3, {x * 0.8, 0.5, z * 0.8}) < random_.in(-0.9, 0.35)) return;
    const Vec3 root = on_ground(x, z) - Vec3{0, 0.02, 0};
    const double tall = random_.in(0.16, 0.42), wide = random_.in(0.008, 0.016);
    const double way = random_.in(0, 2 * kPi), lean = random_.in(0.1, 0.55);
    const Vec3 out{std::cos(way), 0, std::sin(way)}, side{-out.z * wide, 0, out.x * wide};
    const Vec3 points[] = {root - side, root + side,
                           root + Vec3{0, 0.55 * tall, 0} + out * (0.25 * lean * tall) - side * 0.8,
                           root + Vec3{0, 0.55 * tall, 0} + out * (0.25 * lean * tall) + side * 0.8,
                           root + Vec3{0, 0.95 * tall, 0} + out * (lean * tall)};
    shapes_.sheet(points);
  }

  const MeadowSettings& s_;
  const std::uint64_t seed_;
  Random random_;
  Shapes shapes_;
};

void build(const MeadowSettings& s, std::uint64_t seed, Scene* scene) {
  Meadow meadow(s, seed, &scene->mesh);
  meadow.build();
  scene->mesh.scene_size = bounds_of(scene->mesh).longest_side();
  scene->sheet_thickness = 0.01;  // half a per cent of the size would be a blade's length
  const double ground = meadow.height(0, kEyeZ);
  scene->view.eye = {0, ground + 1.25, kEyeZ};
  scene->view.look_at = {0, ground + 1.25, 0};
  scene->view.fov_y = 50 * kPi / 180;
}

}  // namespace

SceneKind meadow_scene() {
  return make_scene_kind("meadow", "Ground with grass, rocks and trees against the sky.", build);
}

}  // namespace obscura::tools

#include <numbers>

#include "scene/scenes/scene.h"
#include "scene/scenes/shapes.h"

// Tall thin things against the sky.

namespace obscura::tools {
namespace {

constexpr double kPi = std::numbers::pi;

struct TowerSettings {
  int masts = 3;
  int poles = 6;
};
template <FieldsOf<TowerSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.masts, Field{"masts", "", closed(0, 20), "Lattice masts, joined by wires."});
  v(s.poles, Field{"poles", "", closed(0, 100), "Poles with lamps."});
}

class Towers {
 public:
  Towers(const TowerSettings& settings, std::uint64_t seed, Mesh* mesh)
      : s_(settings), random_(seed), shapes_(mesh) {}

  void build() {
    shapes_.box({-30, -1, -45}, {30, 0, 25});
    keep({-4.2, 0, -4});
    std::vector<Vec3> masts;
    masts.reserve(s_.masts);
    for (int i = 0; i < s_.masts; ++i) masts.push_back({1.2 + 3.6 * i, 0, -2.0 - 7 * i});
    for (Vec3 foot : masts) mast(foot, 11);
    for (std::size_t i = 1; i < masts.size(); ++i) wires(masts[i - 1], masts[i], 11);
    for (int i = 0; i < s_.poles; ++i) pole({-9 + 3.1 * i, 0, 2.5 - random_.in(0, 9)});
    for (int i = 0; i < 12; ++i) {
      const double x = random_.in(-9, 9), z = random_.in(-12, 3), r = random_.in(0.15, 0.5);
      shapes_.block({x, r * 0.6, z}, {r, 0, 0.3 * r}, {0, r * 0.6, 0}, {-0.3 * r, 0, r});
    }
  }

 private:
  // A round tower with a door step, a gallery on brackets, battlements and a flag.
  void keep(Vec3 foot) {
    const ProfilePoint body[] = {{0, 1.9},    {0.3, 1.9},  {0.4, 1.7}, {5.0, 1.45}, {7.6, 1.4},
                                 {7.9, 1.75}, {8.9, 1.75}, {8.9, 1.5}, {8.3, 1.5}};
    shapes_.lathe(foot, {0, 1, 0}, body, 48);
    const ProfilePoint roof[] = {{8.3, 1.2}, {9.4, 1.2}, {9.45, 1.4}, {11.8, 0.06}, {13.4, 0.03}};
    shapes_.lathe(foot, {0, 1, 0}, roof, 48);
    for (int i = 0; i < 14; ++i) {
      const double a = 2 * kPi * i / 14, c = std::cos(a), s = std::sin(a);
      const Vec3 out{c, 0, s}, side{-s, 0, c};
      shapes_.block(foot + out * 1.63 + Vec3{0, 9.15, 0}, side * 0.2, {0, 0.3, 0}, -1 * out * 0.11);
      shapes_.block(foot + out * 1.55 + Vec3{0, 7.55, 0}, side * 0.1, {0, 0.3, 0}, -1 * out * 0.18);
    }
    for (int i = 0; i < 5; ++i) {
      // Window frames up the wall.
      const double a = 1.3 + 0.2 * i, c = std::cos(a), s = std::sin(a), y = 2 + 1.15 * i;
      const Vec3 out{c, 0, s}, side{-s, 0, c};
      const double r = 1.7 - 0.055 * y;
      for (double k : {-1.0, 1.0}) {
        shapes_.block(foot + out * r + side * (0.2 * k) + Vec3{0, y, 0}, side * 0.05, {0, 0.4, 0},
                      -1 * out * 0.12);
        shapes_.block(foot + out * r + Vec3{0, y + 0.4 * k, 0}, side * 0.3, {0, 0.05, 0},
                      -1 * out * 0.14);
      }
    }
    std::vector<Vec3> flag;
    for (int i = 0; i <= 12; ++i) {
      const double u = i / 12.0;
      const Vec3 p = foot + Vec3{1.5 * u, 13.3 - 0.1 * u, 0.15 * std::sin(7 * u)};
      flag.push_back(p);
      flag.push_back(p - Vec3{0, 0.75 - 0.2 * u, 0});
    }
    shapes_.sheet(flag);
  }

  // Four legs that lean in, braced on each side.
  void mast(Vec3 foot, double tall) {
    constexpr int kLevels = 10;
    auto corner = [&](int leg, int level) {
      const double u = double(level) / kLevels, half = 0.85 * (1 - u) + 0.14 * u;
      const double x = leg == 0 || leg == 3 ? -half : half, z = leg < 2 ? half : -half;
      return foot + Vec3{x, tall * u, z};
    };
    for (int leg = 0; leg < 4; ++leg) {
      const int next = (leg + 1) % 4;
      shapes_.rod(corner(leg, 0), corner(leg, kLevels), 0.05, 8);
      for (int level = 0; level < kLevels; ++level) {
        shapes_.rod(corner(leg, level), corner(next, level + 1), 0.024, 6);
        shapes_.rod(corner(next, level), corner(leg, level + 1), 0.024, 6);
        shapes_.rod(corner(leg, level + 1), corner(next, level + 1), 0.028, 6);
      }
    }
    shapes_.rod(foot + Vec3{0, tall, 0}, foot + Vec3{0, tall + 1.4, 0}, 0.03, 8);
    for (double arm : kArms) {
      const Vec3 middle = foot + Vec3{0, arm * tall, 0};
      shapes_.rod(middle - Vec3{kReach, 0, 0}, middle + Vec3{kReach, 0, 0}, 0.045, 8);
      for (double side : {-1.0, 1.0}) {
        const Vec3 tip = middle + Vec3{side * kReach, 0, 0};
        shapes_.rod(tip, middle + Vec3{0, 0.5, 0}, 0.022, 6);
        const ProfilePoint insulator[] = {{0, 0.02},    {0.08, 0.02}, {0.1, 0.07},
                                          {0.14, 0.07}, {0.16, 0.02}, {0.2, 0.07},
                                          {0.24, 0.07}, {0.26, 0.02}, {0.4, 0.02}};
        shapes_.lathe(tip, {0, -1, 0}, insulator, 12);
      }
    }
  }

  void wires(Vec3 a, Vec3 b, double tall) {
    for (double arm : kArms) {
      for (double side : {-1.0, 1.0}) {
        std::vector<Vec3> path;
        const Vec3 shift{side * kReach, arm * tall - 0.38, 0};
        for (int i = 0; i <= 24; ++i) {
          const double u = i / 24.0;
          path.push_back(a + (b - a) * u + shift - Vec3{0, 0.9 * 4 * u * (1 - u), 0});
        }
        const std::vector<double> radii(path.size(), 0.014);
        shapes_.tube(path, radii, 6);
      }
    }
  }

  void pole(Vec3 foot) {
    const double tall = random_.in(3.2, 4.4), turn = random_.in(0, 2 * kPi);
    const ProfilePoint shaft[] = {{0, 0.16}, {0.25, 0.14}, {0.3, 0.06}, {tall, 0.035}};
    shapes_.lathe(foot, {0, 1, 0}, shaft, 12);
    std::vector<Vec3> arm;
    std::vector<double> radii;
    for (int i = 0; i <= 8; ++i) {
      const double a = kPi * 0.6 * i / 8;
      const double out = 0.4 * (1 - std::cos(a)), up = 0.4 * std::sin(a);
      arm.push_back(foot + Vec3{out * std::cos(turn), tall - 0.02 + up, out * std::sin(turn)});
      radii.push_back(0.03);
    }
    shapes_.tube(arm, radii, 8);
    shapes_.sphere(arm.back() - Vec3{0, 0.13, 0}, 0.14);
  }

  static constexpr double kArms[] = {0.78, 0.92};
  static constexpr double kReach = 1.3;

  const TowerSettings& s_;
  Random random_;
  Shapes shapes_;
};

void build(const TowerSettings& s, std::uint64_t seed, Scene* scene) {
  Towers(s, seed, &scene->mesh).build();
  // The ground, the first part, does not count.
  Mesh above = scene->mesh;
  above.triangles.erase(above.triangles.begin(),
                        above.triangles.begin() + std::ptrdiff_t(above.parts[0].count));
  scene->mesh.scene_size = bounds_of(above).longest_side();
  scene->view.eye = {-0.6, 1.7, 10.5};
  scene->view.look_at = {-0.2, 5.3, -2};
  scene->view.fov_y = 58 * kPi / 180;
}

}  // namespace

SceneKind tower_scene() {
  return make_scene_kind("tower", "A tower, lattice masts, wires and poles against the sky.",
                         build);
}

}  // namespace obscura::tools

#include <numbers>

#include "scene/scenes/scene.h"
#include "scene/scenes/shapes.h"

// A nave between two rows of columns with arches, aisles behind them, steps up to a gate with the
// sky behind it, chains and lamps that hang from the beams: large planes and thin objects, like the
// atria in papers on ambient occlusion.

namespace obscura::tools {
namespace {

constexpr double kPi = std::numbers::pi;

struct HallSettings {
  int bays = 6;
  bool chains = true;
  bool lamps = true;
  int crates = 9;
};
template <FieldsOf<HallSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.bays, Field{"bays", "", closed(2, 20), "Arches on each side."});
  v(s.chains, Field{"chains", "", {}, "Chains between the columns and from the beams."});
  v(s.lamps, Field{"lamps", "", {}, "Rings of lamps that hang from the beams."});
  v(s.crates, Field{"crates", "", closed(0, 100), "Crates, jars and balls on the floor."});
}

constexpr double kBay = 3.2;     // from column to column
constexpr double kNave = 2.9;    // from the middle to the columns' axes
constexpr double kAisle = 5.8;   // to the outer walls
constexpr double kSpring = 3.3;  // where arches begin
constexpr double kCrown = 5.4;   // top of the wall over the arches
constexpr double kCeiling = 6.6;
constexpr double kWall = 0.62;  // thickness of the wall over the arches

class Hall {
 public:
  Hall(const HallSettings& settings, std::uint64_t seed, Mesh* mesh)
      : s_(settings), random_(seed), shapes_(mesh), end_(-settings.bays * kBay) {}

  void build() {
    shell();
    for (double side : {-1.0, 1.0}) {
      for (int i = 0; i <= s_.bays; ++i) column({side * kNave, 0, -i * kBay});
      for (int i = 0; i < s_.bays; ++i) arch(side, -i * kBay);
    }
    for (int i = 0; i <= s_.bays; ++i) beam(-i * kBay);
    steps();
    gate();
    if (s_.chains) {
      for (int i = 0; i < s_.bays; ++i) garland(-i * kBay, i % 2 == 0 ? 1 : -1);
      for (int i = 0; i < s_.bays; ++i) {
        const double x = random_.in(0.8, 1.7) * (i % 2 == 0 ? -1 : 1);
        hanging_chain({x, kCeiling - 0.45, -i * kBay}, random_.in(1.6, 3.2));
      }
    }
    if (s_.lamps) {
      for (int i = 1; i < s_.bays; i += 2) lamp({0, kCeiling - 0.45, -i * kBay});
    }
    for (int i = 0; i < s_.crates; ++i) thing(i);
  }

 private:
  void shell() {
    const double front = 4.5, back = end_ - 3.2, t = 0.4;
    shapes_.box({-kAisle - t, -t, back}, {kAisle + t, 0, front});
    shapes_.box({-kAisle - t, kCeiling, back}, {kAisle + t, kCeiling + t, front});
    shapes_.box({-kNave - kWall / 2, kCrown, back}, {-kNave + kWall / 2, kCeiling, front});
    shapes_.box({kNave - kWall / 2, kCrown, back}, {kNave + kWall / 2, kCeiling, front});
    for (double side : {-1.0, 1.0}) {
      const double inner = side * kAisle, outer = side * (kAisle + t);
      shapes_.box({std::min(inner, outer), 0, back}, {std::max(inner, outer), kCeiling, front});
      // Cornices along the nave and flat pilasters on the outer walls.
      const double face = side * (kNave - kWall / 2);
      shapes_.box({std::min(face, face - side * 0.12), kCrown - 0.08, back},
                  {std::max(face, face - side * 0.12), kCrown + 0.1, front});
      for (int i = 0; i <= s_.bays; ++i) {
        const double z = -i * kBay;
        shapes_.box({std::min(inner, inner - side * 0.18), 0, z - 0.3},
                    {std::max(inner, inner - side * 0.18), kCeiling, z + 0.3});
      }
    }
  }

  void column(Vec3 foot) {
    shapes_.box(foot + Vec3{-0.46, 0, -0.46}, foot + Vec3{0.46, 0.22, 0.46});
    const ProfilePoint profile[] = {{0.2, 0.42},  {0.26, 0.44}, {0.32, 0.42}, {0.36, 0.35},
                                    {0.42, 0.34}, {0.46, 0.31}, {1.4, 0.305}, {2.7, 0.27},
                                    {2.75, 0.31}, {2.8, 0.31},  {2.84, 0.28}, {2.96, 0.32},
                                    {3.08, 0.42}, {3.14, 0.44}};
    shapes_.lathe(foot, {0, 1, 0}, profile, 32);
    shapes_.box(foot + Vec3{-0.48, 3.12, -0.48}, foot + Vec3{0.48, kSpring, 0.48});
  }

  // From the column at `z` to the next one.
  void arch(double side, double z) {
    constexpr int kSegments = 20;
    const double radius = kBay / 2 - 0.34, middle = z - kBay / 2;
    std::vector<Vec3> below, above, inner, outer;
    const double x = side * kNave - kWall / 2;
    auto point = [&](double px, double dz, double y) { return Vec3{px, y, middle + dz}; };
    // The wall starts on the columns' axes, level with the springing.
    below.push_back(point(x, kBay / 2, kSpring));
    above.push_back(point(x, kBay / 2, kCrown));
    for (int i = 0; i <= kSegments; ++i) {
      const double angle = kPi * i / kSegments, dz = radius * std::cos(angle);
      below.push_back(point(x, dz, kSpring + radius * std::sin(angle)));
      above.push_back(point(x, dz, kCrown));
      // A moulding around the opening stands out on both sides.
      inner.push_back(
          point(x - 0.07, radius * std::cos(angle) * 1.0, kSpring + radius * std::sin(angle)));
      outer.push_back(point(x - 0.07, (radius + 0.2) * std::cos(angle),
                            kSpring + (radius + 0.2) * std::sin(angle)));
    }
    below.push_back(point(x, -kBay / 2, kSpring));
    above.push_back(point(x, -kBay / 2, kCrown));
    shapes_.strip(below, above, {kWall, 0, 0});
    shapes_.strip(inner, outer, {kWall + 0.14, 0, 0});
  }

  void beam(double z) {
    shapes_.box({-kNave, kCeiling - 0.45, z - 0.14}, {kNave, kCeiling, z + 0.14});
    for (double side : {-1.0, 1.0}) {
      const double a = side * kNave, b = side * kAisle;
      shapes_.box({std::min(a, b), kCeiling - 0.3, z - 0.1}, {std::max(a, b), kCeiling, z + 0.1});
    }
  }

  void steps() {
    for (int i = 0; i < 5; ++i) {
      shapes_.box({-kNave + 0.2, 0, end_ - 3.2},
                  {kNave - 0.2, 0.17 * (i + 1), end_ + 1.5 - 0.34 * i});
    }
  }

  // The end wall with an arched gate in the middle and a window in each aisle.
  void gate() {
    const double z = end_ - 3.2, t = 0.5;
    auto opening = [&](double middle, double half, double spring, double left, double right,
                       double sill) {
      std::vector<Vec3> above, below;
      const double top = kCeiling;
      above.push_back({left, top, z});
      below.push_back({left, spring, z});
      for (int i = 0; i <= 24; ++i) {
        const double angle = kPi - kPi * i / 24;
        above.push_back({middle + half * std::cos(angle), top, z});
        below.push_back({middle + half * std::cos(angle), spring + half * std::sin(angle), z});
      }
      above.push_back({right, top, z});
      below.push_back({right, spring, z});
      shapes_.strip(above, below, {0, 0, -t});
      shapes_.box({left, 0, z - t}, {middle - half, spring, z});
      shapes_.box({middle + half, 0, z - t}, {right, spring, z});
      if (sill > 0) shapes_.box({middle - half, 0, z - t}, {middle + half, sill, z});
    };
    opening(0, 1.35, 3.1, -kNave, kNave, 0);
    opening(-(kNave + kAisle) / 2, 0.55, 3.4, -kAisle, -kNave, 2.2);
    opening((kNave + kAisle) / 2, 0.55, 3.4, kNave, kAisle, 2.2);
    // A grating in the gate.
    for (int i = -4; i <= 4; ++i)
      shapes_.rod({0.3 * i, 0.5, z - 0.25}, {0.3 * i, 4.5, z - 0.25}, 0.022, 8);
    for (double y : {1.6, 2.6, 3.4}) shapes_.rod({-1.4, y, z - 0.25}, {1.4, y, z - 0.25}, 0.022, 8);
  }

  // Links along a polyline parameter, each turned a right angle against the one before.
  template <class Curve>
  void chain(const Curve& curve, double from, double to, double scale) {
    const double pitch = 0.115 * scale;
    double travelled = 0, next = pitch / 2;
    Vec3 last = curve(from);
    constexpr int kSteps = 2000;
    int count = 0;
    for (int i = 1; i <= kSteps; ++i) {
      const Vec3 here = curve(from + (to - from) * i / kSteps);
      const Vec3 step = here - last;
      travelled += length(step);
      if (travelled >= next) {
        const Frame f = Frame::around(normalize(step));
        shapes_.link(here, f.z, count % 2 == 0 ? f.x : f.y, 0.07 * scale, 0.04 * scale,
                     0.014 * scale, 12, 6);
        ++count;
        next += pitch;
      }
      last = here;
    }
  }

  // Sags from capital to capital across an arch.
  void garland(double z, double side) {
    const double x = side * (kNave - 0.52), sag = random_.in(0.5, 1.0);
    auto curve = [&](double u) { return Vec3{x, 3.0 - sag * 4 * u * (1 - u), z - 0.0 - kBay * u}; };
    chain(curve, 0, 1, 1.2);
  }

  void hanging_chain(Vec3 top, double drop) {
    chain([&](double u) { return top - Vec3{0, drop * u, 0}; }, 0, 1, 1.3);
    const Vec3 hook = top - Vec3{0, drop + 0.09, 0};
    const ProfilePoint weight[] = {{-0.02, 0.02}, {0.0, 0.05}, {0.1, 0.1},
                                   {0.24, 0.13},  {0.3, 0.1},  {0.33, 0.03}};
    shapes_.lathe(hook + Vec3{0, 0.05, 0}, {0, -1, 0}, weight, 20);
  }

  void lamp(Vec3 top) {
    const double drop = 2.0, radius = 0.75;
    const Vec3 center = top - Vec3{0, drop, 0};
    shapes_.link(center, {1, 0, 0}, {0, 0, 1}, 0, radius, 0.045, 48, 10);
    chain([&](double u) { return top - Vec3{0, 0.9 * u, 0}; }, 0, 1, 1);
    for (int i = 0; i < 3; ++i) {
      const double angle = 2 * kPi * i / 3 + 0.4;
      const Vec3 rim = center + Vec3{radius * std::cos(angle), 0, radius * std::sin(angle)};
      const Vec3 knot = top - Vec3{0, 0.9, 0};
      chain([&](double u) { return knot + (rim - knot) * u; }, 0, 1, 0.8);
    }
    for (int i = 0; i < 12; ++i) {
      const double angle = 2 * kPi * (i + 0.5) / 12;
      const Vec3 rim = center + Vec3{radius * std::cos(angle), 0.03, radius * std::sin(angle)};
      const ProfilePoint candle[] = {{0, 0.07}, {0.02, 0.07}, {0.03, 0.03}, {0.2, 0.03}};
      shapes_.lathe(rim, {0, 1, 0}, candle, 12);
    }
  }

  // Crates, jars and balls, in turn, mostly along the columns.
  void thing(int index) {
    const double side = index % 2 == 0 ? 1 : -1;
    const double x = side * random_.in(1.25, 2.1), z = -random_.in(-0.5, s_.bays * kBay - 2.5);
    const double turn = random_.in(0, kPi);
    if (index % 3 == 0) {
      const double half = random_.in(0.22, 0.38);
      const double c = std::cos(turn), s = std::sin(turn);
      shapes_.block({x, half, z}, Vec3{c, 0, -s} * half, {0, half, 0}, Vec3{s, 0, c} * half);
      if (index % 2 == 0) {
        const double small = half * 0.55;
        shapes_.block({x + 0.08, 2 * half + small, z}, {small, 0, 0}, {0, small, 0}, {0, 0, small});
      }
    } else if (index % 3 == 1) {
      const double k = random_.in(0.8, 1.25);
      ProfilePoint jar[] = {{0, 0.16},    {0.06, 0.2},  {0.22, 0.3},  {0.4, 0.33},
                            {0.56, 0.28}, {0.68, 0.16}, {0.76, 0.14}, {0.82, 0.2},
                            {0.86, 0.21}, {0.86, 0.17}, {0.78, 0.11}, {0.7, 0.11}};
      for (ProfilePoint& p : jar) p = {p.along * k, p.out * k};
      shapes_.lathe({x, 0, z}, {0, 1, 0}, jar, 32);
    } else {
      const double r = random_.in(0.2, 0.34);
      shapes_.sphere({x, r, z}, r);
    }
  }

  const HallSettings& s_;
  Random random_;
  Shapes shapes_;
  const double end_;
};

void build(const HallSettings& s, std::uint64_t seed, Scene* scene) {
  Hall(s, seed, &scene->mesh).build();
  scene->mesh.scene_size = bounds_of(scene->mesh).longest_side();
  scene->view.eye = {-0.9, 1.75, 2.2};
  scene->view.look_at = {0.55, 2.35, -6};
  scene->view.fov_y = kPi / 3;
}

}  // namespace

SceneKind hall_scene() {
  return make_scene_kind(
      "hall", "Columns, arches, steps and hanging chains: large planes and thin things.", build);
}

}  // namespace obscura::tools

#include "scene/scenes/shapes.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

namespace obscura::tools {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

std::uint32_t Shapes::add(Vec3 p) {
  mesh_.positions.push_back({float(p.x), float(p.y), float(p.z)});
  return std::uint32_t(mesh_.positions.size() - 1);
}

void Shapes::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh_.triangles.push_back({a, b, c});
}

void Shapes::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

void Shapes::begin(bool closed) {
  // Consecutive sheets share a part.
  if (!closed && !mesh_.parts.empty() && !mesh_.parts.back().closed) return;
  mesh_.parts.push_back({mesh_.triangles.size(), 0, closed});
}

void Shapes::box(Vec3 min, Vec3 max) {
  const Vec3 half = (max - min) * 0.5;
  block((min + max) * 0.5, {half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z});
}

void Shapes::block(Vec3 center, Vec3 hx, Vec3 hy, Vec3 hz) {
  const Vec3 face[] = {center - hx - hy - hz, center + hx - hy - hz, center + hx + hy - hz,
                       center - hx + hy - hz};
  prism(face, hz * 2);
}

void Shapes::prism(std::span<const Vec3> polygon, Vec3 depth) {
  begin(true);
  const auto n = std::uint32_t(polygon.size());
  const auto first = std::uint32_t(mesh_.positions.size());
  for (Vec3 p : polygon) add(p);
  for (Vec3 p : polygon) add(p + depth);
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    triangle(first, first + i + 1, first + i);
    triangle(first + n, first + n + i, first + n + i + 1);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    quad(first + i, first + j, first + n + j, first + n + i);
  }
  end();
}

void Shapes::strip(std::span<const Vec3> a, std::span<const Vec3> b, Vec3 depth) {
  begin(true);
  const auto n = std::uint32_t(a.size());
  const auto first = std::uint32_t(mesh_.positions.size());
  for (auto line : {a, b}) {
    for (Vec3 p : line) add(p);
    for (Vec3 p : line) add(p + depth);
  }
  auto near_a = [&](std::uint32_t i) { return first + i; };
  auto far_a = [&](std::uint32_t i) { return first + n + i; };
  auto near_b = [&](std::uint32_t i) { return first + 2 * n + i; };
  auto far_b = [&](std::uint32_t i) { return first + 3 * n + i; };
  for (std::uint32_t i = 0; i + 1 < n; ++i) {
    quad(near_a(i), near_b(i), near_b(i + 1), near_a(i + 1));
    quad(far_a(i), far_a(i + 1), far_b(i + 1), far_b(i));
    quad(near_a(i), near_a(i + 1), far_a(i + 1), far_a(i));
    quad(near_b(i + 1), near_b(i), far_b(i), far_b(i + 1));
  }
  quad(near_b(0), near_a(0), far_a(0), far_b(0));
  quad(near_a(n - 1), near_b(n - 1), far_b(n - 1), far_a(n - 1));
  end();
}

void Shapes::skin(std::span<const std::uint32_t> rings, int sides, bool loop) {
  const std::size_t joints = loop ? rings.size() : rings.size() - 1;
  for (std::size_t r = 0; r < joints; ++r) {
    const std::uint32_t here = rings[r], next = rings[(r + 1) % rings.size()];
    for (int i = 0; i < sides; ++i) {
      const auto j = std::uint32_t((i + 1) % sides), k = std::uint32_t(i);
      quad(here + k, here + j, next + j, next + k);
    }
  }
  if (loop) return;
  for (int i = 1; i + 1 < sides; ++i) {
    const std::uint32_t head = rings.front(), tail = rings.back(), k = std::uint32_t(i);
    triangle(head, head + k + 1, head + k);
    triangle(tail, tail + k, tail + k + 1);
  }
}

void Shapes::lathe(Vec3 base, Vec3 axis, std::span<const ProfilePoint> profile, int sides) {
  begin(true);
  const Frame frame = Frame::around(normalize(axis));
  std::vector<std::uint32_t> rings;
  for (const ProfilePoint& p : profile) {
    rings.push_back(std::uint32_t(mesh_.positions.size()));
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * kPi * (i + 0.5) / sides;
      add(base + frame.to_world({p.out * std::cos(angle), p.out * std::sin(angle), p.along}));
    }
  }
  skin(rings, sides, false);
  end();
}

void Shapes::tube(std::span<const Vec3> path, std::span<const double> radii, int sides, bool loop) {
  begin(true);
  const int n = int(path.size());
  std::vector<std::uint32_t> rings;
  Frame frame;
  for (int i = 0; i < n; ++i) {
    const Vec3 before = path[loop ? (i + n - 1) % n : std::max(i - 1, 0)];
    const Vec3 after = path[loop ? (i + 1) % n : std::min(i + 1, n - 1)];
    const Vec3 along = normalize(after - before);
    // The ring turns as little as possible from one point to the next.
    if (i == 0) {
      frame = Frame::around(along);
    } else {
      const Vec3 x = normalize(frame.x - along * dot(frame.x, along));
      frame = {x, cross(along, x), along};
    }
    rings.push_back(std::uint32_t(mesh_.positions.size()));
    for (int s = 0; s < sides; ++s) {
      const double angle = 2 * kPi * s / sides;
      add(path[i] + frame.to_world({radii[i] * std::cos(angle), radii[i] * std::sin(angle), 0}));
    }
  }
  skin(rings, sides, loop);
  end();
}

void Shapes::link(Vec3 center, Vec3 along, Vec3 across, double straight, double radius,
                  double thickness, int segments, int sides) {
  std::vector<Vec3> path;
  const std::vector<double> radii(segments + 2, thickness);
  const int bend = segments / 2;
  for (int half = 0; half < 2; ++half) {
    const double sign = half == 0 ? 1 : -1;
    for (int i = 0; i <= bend; ++i) {
      const double angle = kPi * i / bend;
      path.push_back(center + along * (sign * (straight / 2 + radius * std::sin(angle))) +
                     across * (sign * radius * std::cos(angle)));
    }
  }
  tube(path, std::span(radii).first(path.size()), sides, true);
}

void Shapes::ball(Vec3 center, const std::function<double(Vec3)>& radius, int subdivisions) {
  // An octahedron, each face cut into four again and again.
  std::vector<Vec3> points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  using Face = std::array<std::uint32_t, 3>;
  std::vector<Face> faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                             {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, added] = middles.try_emplace(std::minmax(a, b), std::uint32_t(points.size()));
      if (added) points.push_back(normalize(points[a] + points[b]));
      return at->second;
    };
    std::vector<Face> finer;
    for (const auto& [a, b, c] : faces) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Face& f : {Face{a, ab, ca}, Face{ab, b, bc}, Face{ca, bc, c}, Face{ab, bc, ca}}) {
        finer.push_back(f);
      }
    }
    faces = std::move(finer);
  }
  begin(true);
  const auto first = std::uint32_t(mesh_.positions.size());
  for (Vec3 p : points) add(center + p * radius(p));
  for (const auto& [a, b, c] : faces) triangle(first + a, first + b, first + c);
  end();
}

void Shapes::terrain(Vec3 min, Vec3 max, int cells_x, int cells_z, double bottom,
                     const std::function<double(double, double)>& height) {
  begin(true);
  const auto first = std::uint32_t(mesh_.positions.size());
  const auto row = std::uint32_t(cells_x + 1), grid = row * std::uint32_t(cells_z + 1);
  for (int below = 0; below < 2; ++below) {
    for (int j = 0; j <= cells_z; ++j) {
      for (int i = 0; i <= cells_x; ++i) {
        const double x = min.x + (max.x - min.x) * i / cells_x;
        const double z = min.z + (max.z - min.z) * j / cells_z;
        add({x, below ? bottom : height(x, z), z});
      }
    }
  }
  auto at = [&](int i, int j) { return first + std::uint32_t(j) * row + std::uint32_t(i); };
  for (int j = 0; j < cells_z; ++j) {
    for (int i = 0; i < cells_x; ++i) {
      const std::uint32_t a = at(i, j), b = at(i, j + 1), c = at(i + 1, j + 1), d = at(i + 1, j);
      quad(a, b, c, d);
      quad(a + grid, d + grid, c + grid, b + grid);
    }
  }
  auto wall = [&](std::uint32_t a, std::uint32_t b) { quad(b, a, a + grid, b + grid); };
  for (int i = 0; i < cells_x; ++i) {
    wall(at(i + 1, 0), at(i, 0));
    wall(at(i, cells_z), at(i + 1, cells_z));
  }
  for (int j = 0; j < cells_z; ++j) {
    wall(at(0, j), at(0, j + 1));
    wall(at(cells_x, j + 1), at(cells_x, j));
  }
  end();
}

void Shapes::sheet(std::span<const Vec3> points, bool fan) {
  begin(false);
  const auto first = std::uint32_t(mesh_.positions.size());
  for (Vec3 p : points) add(p);
  for (std::uint32_t i = 0; i + 2 < points.size(); ++i) {
    if (fan) {
      triangle(first, first + i + 1, first + i + 2);
    } else {
      triangle(first + i, first + i + 1 + i % 2, first + i + 2 - i % 2);
    }
  }
  end();
}

}  // namespace obscura::tools

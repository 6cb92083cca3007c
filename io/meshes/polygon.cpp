#include "io/meshes/polygon.h"

#include <cmath>

namespace obscura::tools {
namespace {

struct Point {
  double x, y;
};

double area(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Corners in the plane of the polygon's mean normal (Newell), counterclockwise.
std::vector<Point> flatten(std::span<const std::uint32_t> corners, std::span<const Vec3> vertices) {
  Vec3 normal;
  const Vec3 first = vertices[corners[0]];
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    normal = normal + cross(vertices[corners[i]] - first, vertices[corners[i + 1]] - first);
  }
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  std::vector<Point> flat;
  flat.reserve(corners.size());
  for (std::uint32_t corner : corners) {
    const Vec3 p = vertices[corner] - first;
    if (z >= x && z >= y) {
      flat.push_back(normal.z < 0 ? Point{p.y, p.x} : Point{p.x, p.y});
    } else if (x >= y) {
      flat.push_back(normal.x < 0 ? Point{p.z, p.y} : Point{p.y, p.z});
    } else {
      flat.push_back(normal.y < 0 ? Point{p.x, p.z} : Point{p.z, p.x});
    }
  }
  return flat;
}

bool is_convex(const std::vector<Point>& flat) {
  const std::size_t n = flat.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (area(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) < 0) return false;
  }
  return true;
}

bool is_ear(const std::vector<Point>& flat, const std::vector<std::size_t>& left, std::size_t i) {
  const std::size_t n = left.size();
  const std::size_t a = left[(i + n - 1) % n], b = left[i], c = left[(i + 1) % n];
  if (!(area(flat[a], flat[b], flat[c]) > 0)) return false;
  for (std::size_t k : left) {
    if (k == a || k == b || k == c) continue;
    const Point p = flat[k];
    if (area(flat[a], flat[b], p) >= 0 && area(flat[b], flat[c], p) >= 0 &&
        area(flat[c], flat[a], p) >= 0) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool triangulate(std::span<const std::uint32_t> corners, std::span<const Vec3> vertices,
                 std::int64_t* work, std::vector<Mesh::Triangle>* triangles) {
  const std::vector<Point> flat = flatten(corners, vertices);
  std::vector<std::size_t> left(corners.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    triangles->push_back({corners[a], corners[b], corners[c]});
  };
  if (!is_convex(flat)) {
    std::size_t at = 0, looked = 0;
    while (left.size() > 3 && looked < left.size()) {
      const std::size_t n = left.size(), i = at % n;
      *work -= std::int64_t(n);
      if (*work < 0) return false;
      if (is_ear(flat, left, i)) {
        add(left[(i + n - 1) % n], left[i], left[(i + 1) % n]);
        left.erase(left.begin() + std::ptrdiff_t(i));
        looked = 0;
      } else {
        ++looked;
      }
      at = i + 1;
    }
  }
  // What is convex, or has no ear left.
  for (std::size_t i = 1; i + 1 < left.size(); ++i) add(left[0], left[i], left[i + 1]);
  return true;
}

}  // namespace obscura::tools

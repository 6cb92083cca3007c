#include "io/meshes/polygon.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obscura::tools {
namespace {

std::vector<std::uint32_t> count_up(std::size_t n) {
  std::vector<std::uint32_t> corners(n);
  for (std::size_t i = 0; i < n; ++i) corners[i] = std::uint32_t(i);
  return corners;
}

// The sum of the triangles' areas, each seen from where the polygon runs counterclockwise: that of
// the polygon only if none lies outside of it or over another.
double area_of(const std::vector<Vec3>& p, const std::vector<Mesh::Triangle>& triangles, Vec3 up) {
  double sum = 0;
  for (const Mesh::Triangle& t : triangles) {
    const double area = dot(cross(p[t.b] - p[t.a], p[t.c] - p[t.a]), up) / 2;
    EXPECT_GE(area, 0);
    sum += area;
  }
  return sum;
}

std::vector<Mesh::Triangle> cut(const std::vector<Vec3>& p) {
  std::vector<Mesh::Triangle> triangles;
  std::int64_t work = 1'000'000'000;
  EXPECT_TRUE(triangulate(count_up(p.size()), p, &work, &triangles));
  EXPECT_EQ(triangles.size(), p.size() - 2);
  return triangles;
}

TEST(Polygon, ConcaveOnesAreCutInsideInEveryPlane) {
  // An L of area 3 whose first corner is the concave one: a fan would not do from every corner.
  const double flat[][2] = {{1, 1}, {1, 2}, {0, 2}, {0, 0}, {2, 0}, {2, 1}};
  const Vec3 axes[][2] = {{{1, 0, 0}, {0, 1, 0}},
                          {{0, 1, 0}, {0, 0, 1}},
                          {{0, 0, 1}, {1, 0, 0}},
                          {{0, 1, 0}, {1, 0, 0}},
                          {{0.6, 0.8, 0}, {0, 0, 1}}};
  for (const auto& [x, y] : axes) {
    for (std::size_t first = 0; first < 6; ++first) {
      std::vector<Vec3> p;
      for (std::size_t i = 0; i < 6; ++i) {
        const auto& corner = flat[(first + i) % 6];
        p.push_back(x * corner[0] + y * corner[1]);
      }
      EXPECT_NEAR(area_of(p, cut(p), cross(x, y)), 3, 1e-12);
    }
  }
}

TEST(Polygon, StarsAndCombs) {
  std::vector<Vec3> star, comb;
  constexpr int kTips = 150;
  for (int i = 0; i < 2 * kTips; ++i) {
    const double angle = i * 3.14159265358979 / kTips, r = i % 2 ? 1 : 3;
    star.push_back({r * std::cos(angle), r * std::sin(angle), 5});
  }
  // Each tip is a triangle pair over the inner polygon.
  const double step = 3.14159265358979 / kTips;
  EXPECT_NEAR(area_of(star, cut(star), {0, 0, 1}), kTips * 3 * std::sin(step), 1e-9);
  for (int i = 0; i < 100; ++i) {
    comb.push_back({double(100 - i), i % 2 ? 1.0 : 9.0, 0});
  }
  comb.push_back({1, 0, 0});
  comb.push_back({100, 0, 0});
  EXPECT_NEAR(area_of(comb, cut(comb), {0, 0, 1}), 99 * 5.0, 1e-9);
}

TEST(Polygon, WhatTakesTooLongIsSaid) {
  std::vector<Vec3> comb;
  for (int i = 0; i < 2000; ++i) comb.push_back({double(2000 - i), i % 2 ? 1.0 : 9.0, 0});
  std::vector<Mesh::Triangle> triangles;
  std::int64_t work = 1000;
  EXPECT_FALSE(triangulate(count_up(comb.size()), comb, &work, &triangles));
}

}  // namespace
}  // namespace obscura::tools

#ifndef OBSCURA_IO_MESHES_VEC3_H_
#define OBSCURA_IO_MESHES_VEC3_H_

#include <cmath>

namespace obscura::tools {

// World geometry is handled in double; meshes store floats.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  Vec3& operator+=(Vec3 b) { return *this = {x + b.x, y + b.y, z + b.z}; }
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3 operator*(double s, Vec3 a) { return a * s; }
inline Vec3 operator/(Vec3 a, double s) { return {a.x / s, a.y / s, a.z / s}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalize(Vec3 a) { return a / length(a); }
inline bool is_finite(Vec3 a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

// A right-handed orthonormal frame: x = cross(y, z).
struct Frame {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  Vec3 to_world(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3 from_world(Vec3 v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }

  // Any frame whose z is `axis` (unit).
  static Frame around(Vec3 axis) {
    const Vec3 helper = std::abs(axis.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    const Vec3 x = normalize(cross(helper, axis));
    return {x, cross(axis, x), axis};
  }
};

}  // namespace obscura::tools

#endif  // OBSCURA_IO_MESHES_VEC3_H_

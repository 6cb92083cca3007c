#ifndef OBSCURA_SCENE_SCENES_SHAPES_H_
#define OBSCURA_SCENE_SCENES_SHAPES_H_

#include <functional>
#include <span>
#include <vector>

#include "io/meshes/mesh.h"
#include "scene/scenes/random.h"

namespace obscura::tools {

// A point of a profile: `along` an axis and `out` from it.
struct ProfilePoint {
  double along = 0, out = 0;
};

// Adds shapes to a mesh. Everything is a closed part, except sheet(), whose triangles are open.
class Shapes {
 public:
  explicit Shapes(Mesh* mesh) : mesh_(*mesh) {}

  void box(Vec3 min, Vec3 max);
  // A box with any axes: half_x, half_y, half_z point from the centre to its faces.
  void block(Vec3 center, Vec3 half_x, Vec3 half_y, Vec3 half_z);
  // A convex or star-shaped (seen from its first vertex) polygon, counterclockwise seen against
  // `depth`, pushed along `depth`.
  void prism(std::span<const Vec3> polygon, Vec3 depth);
  // A strip of quadrilaterals between two polylines of equal length, pushed along `depth`;
  // counterclockwise (a forward, b backward) seen against `depth`.
  void strip(std::span<const Vec3> a, std::span<const Vec3> b, Vec3 depth);
  // Turns a profile, in order along the axis from `base`, around it; both ends are closed.
  void lathe(Vec3 base, Vec3 axis, std::span<const ProfilePoint> profile, int sides);
  // A tube along a path with one radius per point; `loop` joins its end to its start.
  void tube(std::span<const Vec3> path, std::span<const double> radii, int sides,
            bool loop = false);
  void rod(Vec3 from, Vec3 to, double radius, int sides) {
    const Vec3 path[] = {from, to};
    const double radii[] = {radius, radius};
    tube(path, radii, sides);
  }
  // A chain link: a torus drawn out by `straight` along `along`, in the plane of along and across.
  void link(Vec3 center, Vec3 along, Vec3 across, double straight, double radius, double thickness,
            int segments = 16, int sides = 8);
  // A ball whose radius in each unit direction is `radius`.
  void ball(Vec3 center, const std::function<double(Vec3)>& radius, int subdivisions);
  // Solid ground under height(x, z) on a grid over [min, max], down to `bottom`.
  void terrain(Vec3 min, Vec3 max, int cells_x, int cells_z, double bottom,
               const std::function<double(double, double)>& height);
  void sphere(Vec3 center, double radius) { mesh_.spheres.push_back({center, radius}); }
  // Open triangles: a strip zigzagging between consecutive points, or a fan if `fan`.
  void sheet(std::span<const Vec3> points, bool fan = false);

 private:
  std::uint32_t add(Vec3 p);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
  // Closed rings of `sides` vertices each, counterclockwise seen against the way along the rings.
  void skin(std::span<const std::uint32_t> rings, int sides, bool loop);
  void begin(bool closed);
  void end() { mesh_.parts.back().count = mesh_.triangles.size() - mesh_.parts.back().first; }

  Mesh& mesh_;
};

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_SCENES_SHAPES_H_

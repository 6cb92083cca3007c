#ifndef OBSCURA_SCENE_RAYS_RAY_SCENE_H_
#define OBSCURA_SCENE_RAYS_RAY_SCENE_H_

#include <memory>
#include <vector>

#include "io/meshes/mesh.h"
#include "obscura/status.h"

namespace obscura::tools {

// A mesh made ready for rays (Embree). Calls are safe from many threads at once.
class RayScene {
 public:
  // What a ray met. `normal` is the outward unit normal of a solid, the winding's of a sheet.
  struct Hit {
    double t = 0;  // in multiples of the ray's direction
    Vec3 normal;
    int part = 0;  // of Mesh::parts; spheres follow, one each
  };

  // Takes the mesh over. Its indices must be valid and its coordinates finite. `threads` prepare
  // it; 0: every processor.
  static Status create(Mesh mesh, std::unique_ptr<RayScene>* scene, int threads = 0);
  ~RayScene();

  const Mesh& mesh() const { return mesh_; }
  const Bounds& bounds() const { return bounds_; }
  bool is_closed(int part) const {
    return part >= int(mesh_.parts.size()) || mesh_.parts[part].closed;
  }

  // The nearest surface in front of `origin`. The distance is computed again in double from the
  // primitive that was hit, and where several meet in an edge the same one is always taken.
  bool intersect(Vec3 origin, Vec3 direction, Hit* hit) const;

  // Every surface that the ray crosses, nearest first; degenerate and exactly edge-on triangles are
  // left out. Reuses the storage of `hits`.
  void intersect_all(Vec3 origin, Vec3 direction, std::vector<Hit>* hits) const;

  // Rays of one origin, one lane each.
  static constexpr int kLanes = 16;
  struct Bundle {
    alignas(64) float x[kLanes], y[kLanes], z[kLanes];  // unit directions
    int count = 0;                                      // [0, kLanes]
  };
  // Distances to the nearest surfaces up to `far`; +inf where there is none. With `nearest` false
  // any surface will do, which is faster: 0 where there is one.
  void distances(Vec3 origin, const Bundle& bundle, float far, bool nearest,
                 float distance[kLanes]) const;

  // The closed part or sphere around a point, or -1 where it is in the open.
  int part_around(Vec3 point) const;

 private:
  struct Embree;

  explicit RayScene(Mesh mesh);
  bool refine(unsigned geometry, unsigned primitive, Vec3 origin, Vec3 direction, Hit* hit) const;
  int part_of(std::size_t triangle) const;

  Mesh mesh_;
  Bounds bounds_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_RAYS_RAY_SCENE_H_

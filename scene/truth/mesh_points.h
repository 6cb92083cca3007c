#ifndef OBSCURA_SCENE_TRUTH_MESH_POINTS_H_
#define OBSCURA_SCENE_TRUTH_MESH_POINTS_H_

#include <cstdint>
#include <span>

#include "obscura/falloff.h"
#include "obscura/run_options.h"
#include "scene/rays/ray_scene.h"

namespace obscura::tools {

// Ambient visibility and bent normals at given points of a mesh, for baking.
struct MeshPointSettings {
  Falloff falloff{};
  int rays = 256;
  double offset = 0;
  std::uint32_t seed = 1;
};
template <FieldsOf<MeshPointSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.falloff, v);
  v(s.rays, Field{"rays", "", closed(1, 1 << 20), "Rays per point and kind of output."});
  v(s.offset,
    Field{"offset", "world units", at_least(0),
          "Distance from the surface at which rays start; 0 chooses 1e-5 of the scene size."});
  v(s.seed, Field{"seed", "", anything(), "Seed of the random numbers."});
}

// Three numbers per point: where it is, and the normal there, of any length above 0.
struct MeshPoints {
  std::span<const float> positions, normals;
};
// Empty ones are not written. One number and three per point.
struct MeshPointOutputs {
  std::span<float> visibility;
  std::span<float> bent_normal;
};

// Rays as those of trace_geometric: cosine-weighted ones give the visibility, 1 is open; uniform
// ones the mean direction that is open, the normal where nothing is. The same bits for any number
// of threads. Refuses positions that are not finite and normals of no length.
Status trace_points(const RayScene& scene, const MeshPoints& points,
                    const MeshPointSettings& settings, const MeshPointOutputs& outputs,
                    const RunOptions& options = {});

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_TRUTH_MESH_POINTS_H_

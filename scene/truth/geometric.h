#ifndef OBSCURA_SCENE_TRUTH_GEOMETRIC_H_
#define OBSCURA_SCENE_TRUTH_GEOMETRIC_H_

#include <cstdint>

#include "obscura/falloff.h"
#include "obscura/outputs.h"
#include "obscura/reference.h"
#include "obscura/run_options.h"
#include "scene/scenes/load_scene.h"

namespace obscura::tools {

// Ambient visibility on the real geometry, by ray tracing: the same integrals as those of the
// screen-space reference, but rays meet the scene itself, also what the camera does not see. Takes
// any falloff.
struct GeometricSettings {
  Falloff falloff{};
  int rays = 256;
  RayWeighting weighting = RayWeighting::kCosine;
  int every = 1;  // pixels with x % every == y % every == every / 2
  bool interpolate = false;
  double offset = 0;
  std::uint32_t seed = 1;
};

// Fills those outputs whose views are not empty, which are of the visible size.
//
// Receivers are the surface points of rendering.gbuffer at the pixel centres, lifted by
// settings.offset along the G-buffer's normal. A ray that meets a surface at distance d, from
// either side, has V = 1 - falloff(d). Directions are stratified, one ray in each of settings.rays
// strata of equal weight; cosine-weighted ones give visibility and the cosine integral, uniform
// ones the mean unoccluded direction, its cone angle acos(max(0, 2 |mean direction| - 1)), the
// uniform integral, and visibility where weighting says so. standard_error is that of visibility,
// as Hemisphere::standard_error gives it. Where nothing is open the bent normal is the
// normal. Background pixels get what Outputs says.
//
// Same input, settings and seed: the same bits for any number of threads.
Status trace_geometric(const Rendering& rendering, const GeometricSettings& settings,
                       const Outputs& outputs, const RunOptions& options = {});

template <FieldsOf<GeometricSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.falloff, v);
  v(s.rays, Field{"rays", "", closed(1, 1 << 20), "Rays per pixel and kind of output."});
  v(s.weighting, Field{"weighting",
                       "",
                       {},
                       "How directions are weighted: by the cosine to the normal, or equally."});
  v(s.every, Field{"every", "pixels", closed(1, 1000), "Trace only every N-th pixel in x and y."});
  v(s.interpolate,
    Field{"interpolate", "", {}, "Fill the pixels between; otherwise they are NaN."});
  v(s.offset,
    Field{"offset", "world units", at_least(0),
          "Distance from the surface at which rays start; 0 chooses 1e-5 of the scene size."});
  v(s.seed, Field{"seed", "", anything(), "Seed of the random numbers."});
}

}  // namespace obscura::tools

namespace obscura {

template <>
struct MethodInfo<tools::GeometricSettings> {
  static constexpr const char* name = "geometric";
  static constexpr const char* summary =
      "Reference: rays against the real geometry of a scene or mesh";
  static constexpr const char* page = "docs/scenes.md";
  static constexpr bool on_vulkan = false;
};

}  // namespace obscura

#endif  // OBSCURA_SCENE_TRUTH_GEOMETRIC_H_

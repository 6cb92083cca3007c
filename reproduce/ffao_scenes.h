#ifndef OBSCURA_REPRODUCE_FFAO_SCENES_H_
#define OBSCURA_REPRODUCE_FFAO_SCENES_H_

#include <string>
#include <vector>

#include "obscura/estimator.h"
#include "reproduce/reproduce.h"
#include "scene/scenes/load_scene.h"
#include "scene/truth/compare.h"

// What the reproductions of far-field ambient obscurance share.
namespace obscura::tools {

// How a truth is traced: precisely at every fifth pixel in x and y, for figures, or everywhere, for
// pictures.
struct TruthGrid {
  int every, rays;
};
inline constexpr TruthGrid kSubset{5, 4096}, kEverywhere{1, 1024};

// A scene seen with a guard band of 10 %, and the falloff that it is measured with.
struct FfaoView {
  std::string name;
  Rendering rendering;
  Falloff falloff;
  int width = 0, height = 0;
};

// The paper's two scenes, hall (plane walls, a falloff of 10 % of the scene) and meadow (foliage,
// 4 %), and the kitchen where DATA/meshes/kitchen.ply is there (10 %).
std::vector<std::string> ffao_scenes(const std::string& data);

// One of them; "bunny" (DATA/meshes/stanford-bunny.obj on a plane) or any procedural scene, 5 %.
Status load_ffao_view(const std::string& name, const std::string& data, ImageSize size,
                      Executor& executor, FfaoView* view);

// A depth image of another making with its truth, DATA/depth/NAME.pfm: hall, spheres or terrain.
Status load_ffao_depth(const std::string& name, const std::string& data, FfaoView* view,
                       std::vector<float>* truth);

// What a method gives and what it costs.
struct FfaoRun {
  std::vector<float> visibility;
  double milliseconds = 0;           // median of some runs, the first left out
  double processor_ms = 0;           // mean of all threads' time: other programs do not count
  std::vector<PassTime> pass_times;  // of the run with that time

  double pass(const std::string& name) const;  // 0 where there is no such pass
};
Status run_ffao(const FfaoView& view, const MethodSettings& settings, Executor& executor,
                FfaoRun* run, int runs = 3);

// Truths: of the depth field as the occluder says (solid in the paper), and of the real geometry.
Status trace_depth_field(const FfaoView& view, const TruthGrid& grid, Executor& executor,
                         std::vector<float>* truth, const Occluder& occluder = {});
Status trace_world(const FfaoView& view, const TruthGrid& grid, Executor& executor,
                   std::vector<float>* truth);

// Over pixels with a surface: the background, which a truth has everywhere, would dilute a subset.
// `truth` may be smaller than the view, see compare().
Status compare_ffao(const FfaoView& view, const std::vector<float>& visibility,
                    const std::vector<float>& truth, Comparison* result);

// Settings of methods with the view's falloff.
FarFieldSettings far_field_for(const FfaoView& view, int directions, int segments);
FarFieldSettings far_field_for(const FfaoView& view, FarFieldPreset preset);
FarFieldSettings far_field_of_the_paper(const FfaoView& view, int directions);
MipmapSettings mipmap_for(const FfaoView& view, int directions);
ReferenceSettings tracer_for(const FfaoView& view, int rays);

Status stopped();

}  // namespace obscura::tools

#endif  // OBSCURA_REPRODUCE_FFAO_SCENES_H_

#ifndef OBSCURA_REPRODUCE_BENT_SCENES_H_
#define OBSCURA_REPRODUCE_BENT_SCENES_H_

#include <array>
#include <string>
#include <vector>

#include "obscura/estimator.h"
#include "obscura/lighting.h"
#include "reproduce/reproduce.h"
#include "scene/scenes/load_scene.h"

// What the reproductions of bent normals and cones share.
namespace obscura::tools {

// The scenes of the measurements, at `size` pixels a side.
const std::vector<std::string>& bent_scenes();
Status load_bent_scene(const std::string& name, int size, Executor& executor, Rendering* rendering);

// The sphere of the estimators and of the truth: a tenth of the scene, nothing beyond it occludes.
Falloff bent_falloff(const Rendering& rendering);

// Results of one estimator, visible size.
struct BentBuffers {
  BentBuffers(int width, int height);
  Outputs directions();         // visibility, normal, bent normal, cone angle
  Outputs cosine_directions();  // visibility, normal, cosine integral (in `bent`)

  Image image;
  ImageView<float> visibility, angle;
  VectorView<float> normal, bent;
};

struct NamedLight {
  std::string name;
  Environment environment;
  PreconvolvedEnvironment convolved;
};
// The maps in DATA/environments, or procedural ones, and a hard sun in a clear sky.
Status bent_lights(const std::string& data, Executor& executor, std::vector<NamedLight>* lights);

std::array<float, 9> world_from_eye(const Rendering& rendering);

// The truth that the depth image holds: rays of the reference tracer carry their radiance, the
// sun's disc included. Pixels that are not traced are NaN.
Status lit_truth(const Rendering& rendering, const Environment& light, int rays, int every,
                 Executor& executor, Image* rgb);

// Light by one technique; R, G, B. The rotation of the settings is filled in.
Status lit_by(const BentBuffers& buffers, const Rendering& rendering, const NamedLight& light,
              LightingSettings settings, Executor& executor, Image* rgb);

// Root of the mean squared difference over pixels that have a value in `truth` and a surface.
double rmse(const Image& rgb, const Image& truth, const Rendering& rendering);

// [0, 1] for people: divided by `white`, sRGB; NaN is black.
Image tone(const Image& rgb, double white);

}  // namespace obscura::tools

#endif  // OBSCURA_REPRODUCE_BENT_SCENES_H_

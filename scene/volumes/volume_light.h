#ifndef OBSCURA_SCENE_VOLUMES_VOLUME_LIGHT_H_
#define OBSCURA_SCENE_VOLUMES_VOLUME_LIGHT_H_

#include <string>

#include "io/volumes/volume_image.h"
#include "obscura/surface.h"

namespace obscura::tools {

// The light in a picture of a volume.
struct VolumeLight {
  enum Kind { kAmbient, kHeadlight, kOctants, kShadow, kTranslucent, kLit };
  Kind kind = kAmbient;
  unsigned octants = kAllOctants;  // kOctants: of the world
  bool upper = false;              // kOctants: the four on the side that is up
  Double3 to_light{0, 0, 1};       // kShadow, world
  float alpha = 1;                 // kTranslucent

  static constexpr const char* kForm =
      "lit, ao, headlight, octants:LIST (of 0 to 7, or upper), shadow:X,Y,Z or translucent:ALPHA";
  // Whether rays can stand in for the sweeps.
  bool has_rays() const { return kind == kAmbient || kind == kShadow || kind == kLit; }
};
Status parse_volume_light(const std::string& text, VolumeLight* light);

// Octants of the grid that correspond to octants of the world: each axis of the grid counts as the
// world axis that it is closest to.
unsigned octants_to_grid(const VolumeImage& image, unsigned octants);
unsigned upper_octants(const VolumeImage& image);

// A lamp at the camera: the cosine between the normal and the way to it. The camera must outlive
// the shader.
SurfaceShader camera_lamp(const SurfaceCamera& camera);

// How light is found: by sweeps, or by rays (ambient visibility and shadows only).
struct VolumeTruth {
  bool monte_carlo = false;
  MonteCarloSettings settings{};
};

// Everything that shading reads, made once per volume and light.
class VolumeShading {
 public:
  // Sweeps what the light needs. The distance field must outlive the shading.
  Status prepare(const VolumeImage& image, GridView<const float> distance, const VolumeLight& light,
                 const OcclusionSettings& occlusion, const VolumeTruth& truth,
                 const RunOptions& run);

  // For render_surface; the camera must outlive the shader. kLit is ambient visibility times a sky
  // that is brighter above and a lamp at the camera, half each; a point that is open, faces the
  // camera and points upwards is 1.
  SurfaceShader shader(const SurfaceCamera& camera) const;

  const VisibilityField& field() const { return field_; }

 private:
  Status visibility(int first_row, std::span<const SurfacePoint> points,
                    std::span<float> light) const;

  GridView<const float> distance_;
  VolumeLight light_;
  VolumeTruth truth_;
  std::array<float, 3> to_light_{}, up_{};  // grid space
  LightSettings settings_;
  VisibilityField field_;
};

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_VOLUMES_VOLUME_LIGHT_H_

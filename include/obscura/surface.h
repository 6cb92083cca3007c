#ifndef OBSCURA_SURFACE_H_
#define OBSCURA_SURFACE_H_

#include <array>
#include <functional>
#include <span>

#include "obscura/export.h"
#include "obscura/settings.h"
#include "obscura/status.h"
#include "obscura/views.h"
#include "obscura/volume.h"

// Pictures of an isosurface: rays are sphere-traced through the distance field, hits are refined in
// the scalar field, and the caller says what light a point of the surface gets.

namespace obscura {

// In grid space (see volume.h). `right`, `up` and `forward` are of unit length and at right angles;
// they may be mirrored, which shows a volume right whose axes are mirrored in the world.
struct SurfaceCamera {
  std::array<float, 3> eye{0, 0, 0};
  std::array<float, 3> right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
  bool orthographic = false;
  float fov_y = 0.6f;      // (0, pi) radians, perspective
  float ortho_height = 1;  // (0, inf) world units from the picture's lower to its upper edge
};

struct SurfaceSettings {
  int samples_per_pixel = 4;
};
template <FieldsOf<SurfaceSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.samples_per_pixel,
    Field{"samples_per_pixel", "", closed(1, 256), "Camera rays per pixel, averaged."});
}

struct SurfaceScene {
  VolumeView volume{};
  float isovalue = 0;
  SolidSide solid = SolidSide::kAbove;
  GridView<const float> distance{};  // of sweep_distance with that isovalue and side
};

// Images of one size; those left empty are not written.
struct SurfaceOutputs {
  ImageView<float> visibility{};  // mean over the pixel's rays; a ray that hits nothing counts 1
  ImageView<float> coverage{};    // share of the pixel's rays that hit
  ImageView<float> depth{};       // mean distance along `forward` of those that hit; +inf for none
};

// Writes the light, in [0, 1], at points of the surface. Called from several threads at the same
// time, once per block of rows that has a hit; `first_row` tells the blocks apart.
using SurfaceShader = std::function<Status(int first_row, std::span<const SurfacePoint> points,
                                           std::span<float> light)>;

// Renders the isosurface. A step is a share of the swept distance, hits are found where the
// trilinear scalar field reaches the isovalue, and normals are its central differences. Where
// matter reaches the volume's border the cut is closed by the border itself.
//
// Guarantees: the same bits for any number of threads, if the shader's are.
// Requires: volume and distance of one size. Where the shader fails its status is returned and the
// outputs are unspecified.
OBSCURA_API Status render_surface(const SurfaceScene& scene, const SurfaceCamera& camera,
                                  const SurfaceSettings& settings, const SurfaceShader& shader,
                                  const SurfaceOutputs& outputs, const RunOptions& run = {});

}  // namespace obscura

#endif  // OBSCURA_SURFACE_H_

#include "lighting/gpu.h"

#include <bit>

#include "core/text.h"
#include "lighting/check_rotation.h"
#include "lighting/environment_impl.h"
#include "lighting/light_kernel.h"
#include "shaders/light.h"

namespace obscura::gpu {

Status make_light_program(const LightProgram& light, Program* program) {
  namespace io = light_io;
  const LightingSettings& s = light.settings;
  if (Status status = validate_ranges(s); !status.ok()) return status;
  if (Status status = validate_ranges(PreconvolutionSettings{.cells = light.cells}); !status.ok()) {
    return status;
  }
  const bool bent = s.technique != LightingTechnique::kAmbientOcclusion;
  const Directions directions = light.shape.directions;
  if (bent && directions == Directions::kNone) {
    return invalid_argument(
        text("the technique ", enum_name(s.technique), " needs directions; the shape has none"));
  }
  const int table = program->add_region(
      PreconvolvedEnvironment::table_size({.cells = light.cells}) * sizeof(float));
  // Every binding needs something, read or not.
  program->add(
      {.name = "light",
       .shader = shaders::light,
       .constants = {{io::kTechnique, static_cast<int>(s.technique)},
                     {io::kGeometricTerm, s.geometric_term},
                     {io::kPaper, s.normalisation == ConeNormalisation::kPaper},
                     {io::kUniformWeights, s.weights == VisibilityWeights::kUniform},
                     {io::kUnsigned, directions == Directions::kUnsigned},
                     {io::kAlbedo, light.albedo},
                     {io::kCells, light.cells}},
       .slots = {{io::kVisibilityImageAt, Slot::kVisibilityInput},
                 {io::kNormalImageAt, Slot::kNormalImage},
                 {io::kDirectionImageAt, bent ? Slot::kBentNormalInput : Slot::kVisibilityInput},
                 {io::kAlbedoImageAt, light.albedo ? Slot::kAlbedoImage : Slot::kNormalImage},
                 {io::kTableAt, table},
                 {io::kLightResultAt, Slot::kLightImage}},
       .size = light.shape.visible(),
       .push = push_words(io::Push{})});
  return {};
}

Status make_light_push(const std::array<float, 9>& world_from_eye, const Sun& sun,
                       LightWords* words) {
  if (Status s = lighting::check_rotation(world_from_eye); !s.ok()) return s;
  Sun checked;
  if (Status s = lighting::check_sun(sun, &checked); !s.ok()) return s;
  const auto& m = world_from_eye;
  const lighting::EyeSun eye = lighting::make_eye_sun(world_from_eye, checked);
  const light_io::Push push{.xx = m[0],
                            .xy = m[1],
                            .xz = m[2],
                            .yx = m[3],
                            .yy = m[4],
                            .yz = m[5],
                            .zx = m[6],
                            .zy = m[7],
                            .zz = m[8],
                            .sun_x = eye.direction[0],
                            .sun_y = eye.direction[1],
                            .sun_z = eye.direction[2],
                            .sun_red = eye.rgb[0],
                            .sun_green = eye.rgb[1],
                            .sun_blue = eye.rgb[2],
                            .sun_radius = eye.radius};
  *words = std::bit_cast<LightWords>(push);
  return {};
}

}  // namespace obscura::gpu

#ifndef OBSCURA_SCENE_VOLUMES_VOLUME_PICTURE_H_
#define OBSCURA_SCENE_VOLUMES_VOLUME_PICTURE_H_

#include <array>
#include <optional>

#include "io/images/image.h"
#include "obscura/settings.h"

namespace obscura::tools {

// Red, green and blue as a screen shows them, each in [0, 1].
using Colour = std::array<float, 3>;

struct PictureColours {
  Colour surface{0.96f, 0.88f, 0.77f};
  Colour background{0.13f, 0.15f, 0.19f};
};

// A lit surface in front of a background, channels R, G and B for the screen. `light` is as
// render_surface writes it, where a ray that misses counts 1. A pixel's ray shows
// surface * light^(1/gamma) (Singh et al. 2011, section 3); rays are averaged before that power.
Image picture_of_light(const Image& light, const Image& coverage, const PictureColours& colours,
                       float gamma);

// An isovalue that need not be given; any finite number.
struct OptionalIsovalue : std::optional<float> {
  using std::optional<float>::optional;
};

// A second isosurface around the first, seen through: skin over bone.
struct OuterSurface {
  OptionalIsovalue isovalue{};
  float opacity = 0.35f;
  Colour colour{0.91f, 0.62f, 0.5f};
};

// Images of the outer surface, a channel each, as render_surface writes them; `facing` is lit by a
// lamp at the camera.
struct OuterLayer {
  const Image &light, &coverage, &depth, &facing;
};

// Lays the outer surface over a picture of the inner one, where it lies in front of `inner_depth`.
// It covers as a thin shell does, more where it is seen from the side: 1 - (1 - opacity)^(1/cos).
void add_outer_layer(const OuterLayer& layer, const Image& inner_depth, const OuterSurface& outer,
                     float gamma, Image* picture);

}  // namespace obscura::tools

namespace obscura {
template <>
struct SettingText<tools::OptionalIsovalue> {
  static constexpr const char* form = "a finite number";
  static bool parse(std::string_view text, tools::OptionalIsovalue* value);
  static std::string write(const tools::OptionalIsovalue& value);
};
template <>
struct SettingText<tools::Colour> {
  static constexpr const char* form = "R,G,B, each in [0, 1]";
  static bool parse(std::string_view text, tools::Colour* value);
  static std::string write(const tools::Colour& value);
};

namespace tools {
template <FieldsOf<PictureColours> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.surface, Field{"surface_colour", "", {}, "Of a lit .png: the surface where it is bright."});
  v(s.background, Field{"background_colour", "", {}, "Of a lit .png: behind the surface."});
}
template <FieldsOf<OuterSurface> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.isovalue,
    Field{"outer_iso",
          "value",
          {},
          "Of a lit .png: isovalue of a second surface around the first, seen through."});
  v(s.opacity, Field{"outer_opacity", "", closed(0, 1), "Its opacity where it faces the camera."});
  v(s.colour, Field{"outer_colour", "", {}, "Its colour."});
}
}  // namespace tools
}  // namespace obscura

#endif  // OBSCURA_SCENE_VOLUMES_VOLUME_PICTURE_H_

#ifndef OBSCURA_SCENE_VOLUMES_VOLUME_PICTURE_H_
#define OBSCURA_SCENE_VOLUMES_VOLUME_PICTURE_H_

#include <array>

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

}  // namespace obscura::tools

namespace obscura {
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
}  // namespace tools
}  // namespace obscura

#endif  // OBSCURA_SCENE_VOLUMES_VOLUME_PICTURE_H_

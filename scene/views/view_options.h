#ifndef OBSCURA_SCENE_VIEWS_VIEW_OPTIONS_H_
#define OBSCURA_SCENE_VIEWS_VIEW_OPTIONS_H_

#include <optional>

#include "io/images/view_size.h"
#include "obscura/settings.h"
#include "scene/rays/gbuffer.h"

namespace obscura::tools {

// Options of a view, for procedural scenes and meshes. Options that are not set keep the scene's
// own view, or show the whole mesh.
struct ViewOptions {
  ImageSize size{};
  GuardBandSpec guard_band{};
  std::optional<Vec3> eye{}, look_at{}, up{};
  std::optional<double> fov_y{}, ortho_height{};
  int layers = 0;
  bool back_depth = false;
  double sheet_thickness = 0;  // 0: the scene's own, or 0.5 % of the scene size

  LayerSpec layer_spec() const { return {layers, back_depth, sheet_thickness}; }
};

// Lays the options over a default view and checks the result.
Status apply_options(const ViewOptions& options, ViewSpec* view);

}  // namespace obscura::tools

namespace obscura {

template <>
struct SettingText<std::optional<tools::Vec3>> {
  static constexpr const char* form = "X,Y,Z";
  static bool parse(std::string_view text, std::optional<tools::Vec3>* value);
  static std::string write(const std::optional<tools::Vec3>& value);
};
namespace tools {

template <FieldsOf<ViewOptions> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.size, Field{"size", "", {}, "Visible size of the image."});
  v(s.guard_band, Field{"guard_band", "", {}, "Guard band on each side."});
  v(s.eye, Field{"eye", "world units", {}, "Where the camera stands."});
  v(s.look_at, Field{"look_at", "world units", {}, "The point that it looks at."});
  v(s.up, Field{"up", "", {}, "The direction that is up in the image."});
  v(s.fov_y, Field{"fov_y", "degrees", {}, "Vertical field of view of the visible part."});
  v(s.ortho_height, Field{"ortho_height",
                          "world units",
                          {},
                          "Height of the visible part; makes the view orthographic."});
  v(s.layers, Field{"layers", "", closed(0, 64), "Depth layers to render, nearest first."});
  v(s.back_depth, Field{"back_depth", "", {}, "Render where the first layer's matter ends."});
  v(s.sheet_thickness, Field{"sheet_thickness", "world units", at_least(0),
                             "Extent of open sheets along the view ray; 0 is the scene's "
                             "own or 0.5 % of its size."});
}

}  // namespace tools
}  // namespace obscura

#endif  // OBSCURA_SCENE_VIEWS_VIEW_OPTIONS_H_

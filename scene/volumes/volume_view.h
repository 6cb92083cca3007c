#ifndef OBSCURA_SCENE_VOLUMES_VOLUME_VIEW_H_
#define OBSCURA_SCENE_VOLUMES_VOLUME_VIEW_H_

#include <optional>

#include "io/volumes/volume_image.h"
#include "obscura/surface.h"
#include "scene/views/view_options.h"

namespace obscura::tools {

enum class Projection { kPerspective, kOrthographic };

// Options of the view of a volume, in world space. Options that are not set are chosen so that all
// matter is visible.
struct VolumeViewOptions {
  ImageSize size{768, 768};
  Projection camera = Projection::kPerspective;
  std::optional<Vec3> eye{}, look_at{}, up{};
  std::optional<double> fov_y{}, ortho_height{};
};

// The camera in the volume's grid space. By default it looks obliquely from above at all voxels
// where `distance` is not positive, and they fill 84 % of the picture's width or height; `up` is
// the image's. In anatomical space it stands ahead of the patient, towards the right side.
Status place_camera(const VolumeImage& image, GridView<const float> distance,
                    const VolumeViewOptions& options, SurfaceCamera* camera,
                    const RunOptions& run = {});

}  // namespace obscura::tools

namespace obscura {
template <>
struct EnumNames<tools::Projection> {
  static constexpr const char* names[] = {"perspective", "orthographic"};
};

namespace tools {
template <FieldsOf<VolumeViewOptions> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.size, Field{"size", "", {}, "Size of the image."});
  v(s.camera, Field{"camera", "", {}, "Projection; --ortho-height makes it orthographic too."});
  v(s.eye, Field{"eye", "world units", {}, "Where the camera stands."});
  v(s.look_at, Field{"look_at", "world units", {}, "The point that it looks at."});
  v(s.up, Field{"up", "", {}, "The direction that is up in the image."});
  v(s.fov_y, Field{"fov_y", "degrees", {}, "Vertical field of view; 35 by default."});
  v(s.ortho_height, Field{"ortho_height", "world units", {}, "Height of an orthographic view."});
}
}  // namespace tools
}  // namespace obscura

#endif  // OBSCURA_SCENE_VOLUMES_VOLUME_VIEW_H_

#ifndef OBSCURA_SCENE_VOLUMES_VOLUME_FRAMING_H_
#define OBSCURA_SCENE_VOLUMES_VOLUME_FRAMING_H_

#include <optional>
#include <vector>

#include "io/meshes/vec3.h"
#include "io/volumes/volume_image.h"
#include "obscura/run_options.h"

namespace obscura::tools {

// Where matter begins and ends in the rows of a volume. Every corner of its convex hull is the end
// of a row, so that a picture which shows all ends shows all of it.
class MatterOutline {
 public:
  // Matter is where `distance` is not positive; the whole volume where there is none.
  MatterOutline(const VolumeImage& image, GridView<const float> distance, const RunOptions& run);

  Vec3 middle() const { return 0.5 * (low_ + high_); }  // of its box along the grid's axes
  double reach() const { return 0.5 * length(high_ - low_); }
  // How far the surface may lie beyond a voxel's centre.
  double margin() const;

  // Calls with the world position of the ends of all rows.
  template <class Visitor>
  void for_each(Visitor&& visit) const {
    for (std::size_t row = 0; row < ends_.size(); ++row) {
      const auto [first, last] = ends_[row];
      if (first > last) continue;
      const Vec3 start = origin_ + double(row % rows_) * axes_[1] + double(row / rows_) * axes_[2];
      visit(start + double(first) * axes_[0]);
      if (last > first) visit(start + double(last) * axes_[0]);
    }
  }

 private:
  struct Ends {
    std::int16_t first = 1, last = 0;  // none
  };
  std::vector<Ends> ends_;
  std::size_t rows_ = 0;
  Vec3 origin_, axes_[3], low_, high_;
};

// Directions of a picture, of unit length and at right angles, in the world.
struct ViewAxes {
  Vec3 right, up, forward;
};

// The place from which a perspective camera shows all of the outline over `filled` of the picture's
// width or height, whichever is tighter; in the middle of the picture, or with `look_at` there.
// `slope` is the tangent of half the vertical field of view.
Vec3 fit_perspective(const MatterOutline& outline, const ViewAxes& axes,
                     const std::optional<Vec3>& look_at, double slope, double aspect,
                     double filled);

// The same for an orthographic camera: where it stands, and the height of what it shows.
struct OrthographicFit {
  Vec3 eye;
  double height = 0;
};
OrthographicFit fit_orthographic(const MatterOutline& outline, const ViewAxes& axes,
                                 const std::optional<Vec3>& look_at, double aspect, double filled);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_VOLUMES_VOLUME_FRAMING_H_

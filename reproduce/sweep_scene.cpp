#include "reproduce/sweep_scene.h"

#include <algorithm>
#include <cmath>

#include "io/pictures/pictures.h"
#include "scene/volumes/histogram.h"
#include "scene/volumes/load_volume.h"

namespace obscura::tools {
namespace {

using Float3 = std::array<float, 3>;

Float3 along(Float3 p, const Float3& d, float t) {
  for (int a = 0; a < 3; ++a) p[a] += t * d[a];
  return p;
}
Float3 unit(Float3 v) {
  const float length = std::hypot(v[0], v[1], v[2]);
  for (float& c : v) c /= length;
  return v;
}
Float3 cross(const Float3& a, const Float3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The function that is positive in the open, trilinear between voxels.
class OpenField {
 public:
  OpenField(const VolumeView& v, float isovalue, SolidSide solid) : view_(v) {
    values_.resize(std::size_t(v.size[0]) * v.size[1] * v.size[2]);
    for (int z = 0; z < v.size[2]; ++z) {
      for (int y = 0; y < v.size[1]; ++y) volume_row(v, y, z, &values_[at(0, y, z)]);
    }
    const float sign = solid == SolidSide::kAbove ? -1.0f : 1.0f;
    for (float& f : values_) f = sign * (f - isovalue);
  }

  bool inside(const Float3& p) const {
    for (int a = 0; a < 3; ++a) {
      if (!(p[a] >= 0 && p[a] <= view_.spacing[a] * float(view_.size[a] - 1))) return false;
    }
    return true;
  }
  float operator()(const Float3& p) const {
    int i[3], n[3];
    float f[3];
    for (int a = 0; a < 3; ++a) {
      const float u = std::clamp(p[a] / view_.spacing[a], 0.0f, float(view_.size[a] - 1));
      i[a] = int(u);
      n[a] = std::min(i[a] + 1, view_.size[a] - 1);
      f[a] = u - float(i[a]);
    }
    auto row = [&](int y, int z) {
      const float low = values_[at(i[0], y, z)];
      return low + f[0] * (values_[at(n[0], y, z)] - low);
    };
    auto plane = [&](int z) {
      const float low = row(i[1], z);
      return low + f[1] * (row(n[1], z) - low);
    };
    const float low = plane(i[2]);
    return low + f[2] * (plane(n[2]) - low);
  }
  Float3 normal(const Float3& p) const {
    Float3 g{};
    for (int a = 0; a < 3; ++a) {
      Float3 low = p, high = p;
      low[a] -= 0.5f * view_.spacing[a];
      high[a] += 0.5f * view_.spacing[a];
      g[a] = ((*this)(high) - (*this)(low)) / view_.spacing[a];
    }
    return unit(g);
  }

 private:
  std::size_t at(int x, int y, int z) const {
    return x + std::size_t(view_.size[0]) * (y + std::size_t(view_.size[1]) * z);
  }
  VolumeView view_;
  std::vector<float> values_;
};

// The first point of a ray on the surface. A ray that enters the volume in matter meets its cut
// side, which is not a surface: such pixels are left out.
bool hit(const OpenField& field, const Float3& start, const Float3& direction, float end,
         float step, Float3* point) {
  bool before = false;
  for (float t = 0; t < end; t += step) {
    const Float3 p = along(start, direction, t);
    if (!field.inside(p)) {
      before = false;
      continue;
    }
    if (field(p) <= 0) {
      if (!before) return false;
      float open = t - step, matter = t;
      for (int i = 0; i < 16; ++i) {
        const float middle = 0.5f * (open + matter);
        (field(along(start, direction, middle)) <= 0 ? matter : open) = middle;
      }
      *point = along(start, direction, open);
      return true;
    }
    before = true;
  }
  return false;
}

// Keeps one of `every` planes along z.
void thin(int every, VolumeImage* image) {
  const std::size_t plane = bytes_of(image->type) * image->size[0] * image->size[1];
  const int kept = (image->size[2] + every - 1) / every;
  for (int z = 1; z < kept; ++z) {
    std::copy_n(image->samples.data() + std::size_t(z) * every * plane, plane,
                image->samples.data() + std::size_t(z) * plane);
  }
  image->samples.resize(std::size_t(kept) * plane);
  image->size[2] = kept;
  for (double& c : image->axes[2]) c *= every;
}

}  // namespace

Image SweepScene::picture(const std::vector<float>& values) const {
  std::vector<float> all(std::size_t(side) * side, 1.0f);
  for (std::size_t i = 0; i < values.size(); ++i) all[pixels[i]] = values[i];
  return grey_picture(ImageView<const float>(all.data(), side, side));
}

Status load_sweep_scene(const SweepSource& source, int side, const RunOptions& run,
                        SweepScene* scene) {
  const int threads = run.executor ? run.executor->thread_count() : run.threads;
  if (Status s = load_volume(source.spec, {}, &scene->image, threads); !s.ok()) return s;
  thin(source.every, &scene->image);
  const VolumeImage& image = scene->image;
  DistanceSettings settings;
  if (image.isovalue) {
    settings.isovalue = *image.isovalue;
  } else {
    Histogram histogram;
    double threshold;
    if (Status s = make_histogram(image, &histogram); !s.ok()) return s;
    if (Status s = otsu_threshold(image, histogram, &threshold); !s.ok()) return s;
    settings.isovalue = float(threshold);
  }
  settings.isovalue += source.offset;
  if (image.solid) settings.solid = *image.solid;
  const VolumeView view = image.view();
  scene->distance.resize(std::size_t(image.voxels()));
  const GridView<float> grid(scene->distance.data(), view.size, view.spacing);
  if (Status s = sweep_distance(view, settings, grid, run); !s.ok()) return s;

  const OpenField field(view, settings.isovalue, settings.solid);
  scene->side = side;
  scene->view = unit({-0.5f, -0.6f, -0.62f});
  const Float3 right = unit(cross(scene->view, {0, 0, 1})), up = cross(right, scene->view);
  Float3 middle{};
  float radius = 0, step = view.spacing[0];
  for (int a = 0; a < 3; ++a) {
    middle[a] = 0.5f * view.spacing[a] * float(view.size[a] - 1);
    radius = std::hypot(radius, middle[a]);
    step = std::min(step, view.spacing[a]);
  }
  scene->points.clear();
  scene->pixels.clear();
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      Float3 p = along(middle, right, radius * (2 * (float(x) + 0.5f) / float(side) - 1));
      p = along(p, up, radius * (1 - 2 * (float(y) + 0.5f) / float(side)));
      p = along(p, scene->view, -radius);
      SurfacePoint point;
      if (!hit(field, p, scene->view, 2 * radius, 0.25f * step, &point.position)) continue;
      point.normal = field.normal(point.position);
      if (!std::isfinite(point.normal[0])) continue;
      scene->points.push_back(point);
      scene->pixels.push_back(y * side + x);
    }
  }
  if (scene->points.empty())
    return invalid_input(source.spec + ": no pixel of the view hits its surface");
  return {};
}

}  // namespace obscura::tools

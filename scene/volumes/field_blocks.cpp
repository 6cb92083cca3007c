#include "scene/volumes/field_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace obscura::tools {

std::vector<std::string> field_names(FieldsKind kind) {
  if (kind == FieldsKind::kDistance) return {"distance"};
  if (kind == FieldsKind::kScalar) return {"visibility"};
  std::vector<std::string> names;
  for (int s = 0; s < 8; ++s) names.push_back(fmt::format("visibility_octant_{}", s));
  return names;
}

FieldGrid field_grid(FieldsKind kind, const VolumeImage& image, const VisibilityField& field) {
  if (kind == FieldsKind::kDistance) return {image.size, image.axes, image.origin};
  FieldGrid grid;
  const Double3 h = image.spacing();
  grid.size = field.size();
  const auto spacing = field.spacing(), origin = field.origin();
  grid.origin = image.to_world({origin[0], origin[1], origin[2]});
  for (int a = 0; a < 3; ++a) {
    for (int k = 0; k < 3; ++k) grid.axes[a][k] = image.axes[a][k] / h[a] * spacing[a];
  }
  return grid;
}

std::vector<Slab> split_planes(int depth, int cell, int count) {
  const std::int64_t cells = (depth + cell - 1) / cell;
  const std::int64_t slabs = std::min<std::int64_t>(count, cells);
  std::vector<Slab> result;
  for (std::int64_t i = 0; i < slabs; ++i) {
    result.push_back(
        {int(cells * i / slabs * cell), std::min(depth, int(cells * (i + 1) / slabs * cell))});
  }
  return result;
}

Status SlabSamples::read(const PlaneFile& file, const Slab& slab) {
  below = slab.begin > 0;
  above = slab.end < file.volume().size[2];
  return file.read(slab.begin - int(below), slab.end + int(above), &image);
}

VolumeView SlabSamples::own() const {
  VolumeView view = image.view();
  const std::size_t plane = bytes_of(image.type) * std::size_t(image.size[0]) * image.size[1];
  view.data = image.samples.data() + (below ? plane : 0);
  view.size[2] -= int(below) + int(above);
  return view;
}

void add_to_range(const VolumeRange& slab, VolumeRange* all) {
  if (slab.finite == 0) return;
  all->min = all->finite == 0 ? slab.min : std::min(all->min, slab.min);
  all->max = all->finite == 0 ? slab.max : std::max(all->max, slab.max);
  all->finite += slab.finite;
}

Status slab_range(const SlabSamples& samples, const RunOptions& run, VolumeRange* range) {
  *range = {};
  const Status s = volume_range(samples.own(), range, run);
  // That no value is finite is an error of the whole volume only.
  return s.code() == StatusCode::kInvalidInput ? Status() : s;
}

Status field_values(FieldsKind kind, const VisibilityField& field, const RunOptions& run,
                    std::vector<float>* values) {
  const auto n = field.size();
  const std::ptrdiff_t channels = kind == FieldsKind::kScalar ? 1 : 8;
  values->resize(std::size_t(channels) * n[0] * n[1] * n[2]);
  const std::array<std::ptrdiff_t, 3> stride{channels, channels * n[0], channels * n[0] * n[1]};
  for (int c = 0; c < channels; ++c) {
    const GridView<float> out(values->data() + c, n, field.spacing(), stride);
    if (Status s = kind == FieldsKind::kScalar ? field.scalar(out, run) : field.octant(c, out);
        !s.ok()) {
      return s;
    }
  }
  return {};
}

}  // namespace obscura::tools

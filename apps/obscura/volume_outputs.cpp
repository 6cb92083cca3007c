// What obscura volume writes.
#include <cmath>

#include "apps/obscura/volume_command.h"
#include "fmt/format.h"
#include "io/images/files.h"
#include "io/volumes/vdb.h"

namespace obscura::app {

Status write_volume_fields(const std::string& path, FieldsKind kind,
                           const tools::VolumeImage& image, const std::vector<float>& distance,
                           const VisibilityField& field, const RunOptions& run) {
  const tools::FieldGrid grid = tools::field_grid(kind, image, field);
  std::vector<tools::NamedField> fields;
  for (const std::string& name : tools::field_names(kind)) fields.push_back({name, {}});
  if (kind == FieldsKind::kDistance) {
    fields[0].values = distance;
  } else {
    const std::size_t voxels = std::size_t(grid.size[0]) * grid.size[1] * grid.size[2];
    for (std::size_t i = 0; i < fields.size(); ++i) {
      fields[i].values.resize(voxels);
      const GridView<float> view(fields[i].values.data(), grid.size, field.spacing());
      if (Status status = kind == FieldsKind::kScalar ? field.scalar(view, run)
                                                      : field.octant(static_cast<int>(i), view);
          !status.ok()) {
        return status;
      }
    }
  }
  return tools::file_ending(path) == ".vdb" ? tools::write_vdb(path, grid, fields)
                                            : tools::write_nrrd(path, grid, fields);
}

void VolumePictures::allocate(int width, int height) {
  for (tools::Image* image : {&visibility, &coverage, &depth, &facing}) {
    *image = tools::Image(width, height);
    image->add("Y");
  }
}

double mean_visibility(const VolumePictures& pictures) {
  double sum = 0, covered = 0;
  const std::vector<float>& coverage = pictures.coverage.channels[0].values;
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    const double c = coverage[i];
    sum += pictures.visibility.channels[0].values[i] - (1 - c);
    covered += c;
  }
  return covered > 0 ? sum / covered : NAN;
}

Status write_volume_picture(const std::string& path, const tools::WriteOptions& write,
                            const VolumeRequest& p, VolumePictures all,
                            const VolumePictures* outer) {
  const float gamma = float(p.gamma);
  if (p.picture) {
    const PictureSettings& settings = p.settings.picture;
    tools::Image picture =
        tools::picture_of_light(all.visibility, all.coverage, settings.colours, gamma);
    if (outer) {
      tools::add_outer_layer({outer->visibility, outer->coverage, outer->depth, outer->facing},
                             all.depth, settings.outer, gamma, &picture);
    }
    return tools::write_image(path, picture, write);
  }
  if (gamma != 1) {
    for (float& v : all.visibility.channels[0].values) v = std::pow(v, 1 / gamma);
  }
  tools::Image result(all.visibility.width, all.visibility.height);
  if (p.visibility) result.add("visibility") = std::move(all.visibility.channels[0].values);
  if (p.coverage) result.add("coverage") = std::move(all.coverage.channels[0].values);
  if (p.depth) result.add("depth") = std::move(all.depth.channels[0].values);
  return tools::write_image(path, result, write);
}

}  // namespace obscura::app

// Volume files, and pictures of an isosurface.
#include <cmath>

#include "files/module.h"
#include "io/meshes/load_mesh.h"
#include "io/volumes/nrrd.h"
#include "library/run.h"
#include "library/volume_arrays.h"
#include "scene/volumes/load_volume.h"
#include "scene/volumes/volume_light.h"
#include "scene/volumes/volume_picture.h"
#include "scene/volumes/volume_view.h"

namespace obscura::python {

// All settings of a picture; the light brings the opacity of matter.
struct PictureOfVolume {
  tools::VolumeViewOptions view{};
  SurfaceSettings surface{};
  DistanceSettings distance{};
  OcclusionSettings occlusion{};
  tools::PictureColours colours{};
};
template <FieldsOf<PictureOfVolume> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.view, v);
  visit_fields(s.surface, v);
  visit_fields(s.distance, v);
  visit_fields(s.occlusion, [&](auto& value, const Field& field) {
    if (std::string_view(field.name) != "alpha") v(value, field);
  });
  visit_fields(s.colours, v);
}

namespace {

// A volume's file in memory.
struct Loaded {
  tools::VolumeImage image;

  // (Z, Y, X) of the samples themselves.
  static py::array samples(const py::object& self) {
    auto& image = self.cast<Loaded&>().image;
    const std::vector<py::ssize_t> shape = {image.size[2], image.size[1], image.size[0]};
    void* data = image.samples.data();
    switch (image.type) {
      case VoxelType::kU8:
        return py::array(py::dtype::of<std::uint8_t>(), shape, {}, data, self);
      case VoxelType::kI16:
        return py::array(py::dtype::of<std::int16_t>(), shape, {}, data, self);
      case VoxelType::kU16:
        return py::array(py::dtype::of<std::uint16_t>(), shape, {}, data, self);
      case VoxelType::kF32:
        break;
    }
    return py::array(py::dtype::of<float>(), shape, {}, data, self);
  }
  std::array<double, 3> spacing() const {
    const auto h = image.spacing();
    return {h[2], h[1], h[0]};
  }
  std::pair<double, double> scale() const { return {image.slope, image.intercept}; }
  std::optional<float> isovalue() const { return image.isovalue; }
  std::optional<std::string> solid() const {
    return image.solid ? std::optional<std::string>(enum_name(*image.solid)) : std::nullopt;
  }
  std::vector<std::string> notes() const { return image.notes; }
};

std::unique_ptr<Loaded> read_volume(const std::string& path, std::optional<int> index,
                                    int threads) {
  auto loaded = std::make_unique<Loaded>();
  run(threads, py::none(), [&](const RunOptions& options) {
    return tools::load_volume(path, std::nullopt, &loaded->image, options.threads, {"", index});
  });
  return loaded;
}

void write_volume(const std::string& path, const py::object& array,
                  const std::array<double, 3>& spacing) {
  const GridView<const float> g = float_grid("volume", array, spacing);
  const auto step = g.strides();
  tools::NamedField field{"value", {}};
  for (int z = 0; z < g.size[2]; ++z) {
    for (int y = 0; y < g.size[1]; ++y) {
      for (int x = 0; x < g.size[0]; ++x) {
        field.values.push_back(g.data[x * step[0] + y * step[1] + z * step[2]]);
      }
    }
  }
  tools::FieldGrid grid{g.size, {}, {}};
  for (int a = 0; a < 3; ++a) grid.axes[a][a] = spacing[2 - a];
  raise_of_file(tools::write_nrrd(path, grid, {&field, 1}));
}

// (H, W, 3) for the light "lit", else (H, W).
py::array picture(const py::object& samples, const std::array<double, 3>& spacing, double slope,
                  double intercept, const Loaded* place, const std::string& light, double gamma,
                  const GivenSettings& given, int threads, const py::object& progress) {
  const VolumeView volume = volume_view(samples, spacing, slope, intercept);
  auto settings = read_settings<PictureOfVolume>("volume_picture", given);
  // Where the volume lies; its samples stay the array's.
  tools::VolumeImage image;
  image.name = "volume";
  image.size = volume.size;
  for (int a = 0; a < 3; ++a) {
    image.axes[a] = {};
    image.axes[a][a] = spacing[2 - a];
  }
  if (place) {
    image.axes = place->image.axes;
    image.origin = place->image.origin;
    image.up = place->image.up;
  }
  tools::VolumeLight lamp;
  raise(tools::parse_volume_light(light, &lamp));
  raise(tools::check_geometry(image));
  const std::size_t voxels = static_cast<std::size_t>(image.voxels());
  const auto [width, height] = settings.view.size;
  std::vector<float> distances, shown(std::size_t(width) * height), covered(shown.size());
  tools::Image lit(width, height), coverage(width, height);
  run(threads, progress, [&](const RunOptions& options) -> Status {
    distances.resize(voxels);
    const GridView<float> distance(distances.data(), volume.size, volume.spacing);
    auto third = [&](double first) {
      RunOptions o = options;
      o.progress = [&options, first](double s) { return options.progress(first + s / 3); };
      return o;
    };
    if (Status s = sweep_distance(volume, settings.distance, distance, third(0)); !s.ok()) return s;
    SurfaceCamera camera;
    if (Status s = tools::place_camera(image, distance, settings.view, &camera, options); !s.ok()) {
      return s;
    }
    tools::VolumeShading shading;
    if (Status s = shading.prepare(image, distance, lamp, settings.occlusion, {}, third(1.0 / 3));
        !s.ok()) {
      return s;
    }
    return render_surface({volume, settings.distance.isovalue, settings.distance.solid, distance},
                          camera, settings.surface, shading.shader(camera),
                          {{shown.data(), width, height}, {covered.data(), width, height}, {}},
                          third(2.0 / 3));
  });
  if (lamp.kind != tools::VolumeLight::kLit) return to_array(shown, {height, width});
  lit.add("Y") = std::move(shown);
  coverage.add("Y") = std::move(covered);
  const tools::Image rgb =
      tools::picture_of_light(lit, coverage, settings.colours, static_cast<float>(gamma));
  py::array_t<float> result({py::ssize_t{height}, py::ssize_t{width}, py::ssize_t{3}});
  float* at = result.mutable_data();
  for (std::size_t i = 0; i < rgb.channels[0].values.size(); ++i) {
    for (const auto& c : rgb.channels) *at++ = c.values[i];
  }
  return result;
}

}  // namespace

void add_volume_files(py::module_& m) {
  py::class_<Loaded>(m, "Loaded")
      .def_static("samples", &Loaded::samples)
      .def("spacing", &Loaded::spacing)
      .def("scale", &Loaded::scale)
      .def("isovalue", &Loaded::isovalue)
      .def("solid", &Loaded::solid)
      .def("notes", &Loaded::notes);
  m.def("is_volume", &tools::is_volume);
  m.def("is_mesh", &tools::is_mesh);
  m.def("read_volume", &read_volume);
  m.def("write_volume", &write_volume);
  m.def("picture", &picture);
  m.def("picture_settings", &setting_rows<PictureOfVolume>);
}

}  // namespace obscura::python

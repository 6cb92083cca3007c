// obscura._library: the library's calls for the Python files beside it, which users see.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <map>
#include <optional>

#include "library/arrays.h"
#include "library/module.h"
#include "library/run.h"
#include "library/settings.h"
#include "obscura/obscura.h"

namespace obscura::python {
namespace {

using Settings = GivenSettings;

MethodSettings settings_of(const std::string& method, const Settings& given) {
  MethodSettings settings;
  raise(make_settings(method, &settings));
  for (const auto& [field, text] : given) raise(set(&settings, field, text));
  return settings;
}

// (orthographic, scale_x, scale_y, center_u, center_v)
using CameraTuple = std::tuple<bool, double, double, double, double>;

Camera camera_of(const CameraTuple& t) {
  Camera c;
  c.orthographic = std::get<0>(t);
  c.scale_x = static_cast<float>(std::get<1>(t));
  c.scale_y = static_cast<float>(std::get<2>(t));
  c.center_u = static_cast<float>(std::get<3>(t));
  c.center_v = static_cast<float>(std::get<4>(t));
  return c;
}

CameraTuple tuple_of(const Camera& c) {
  return {c.orthographic, c.scale_x, c.scale_y, c.center_u, c.center_v};
}

GuardBand guard_of(const std::array<int, 4>& g) { return {g[0], g[1], g[2], g[3]}; }

// All that describes a depth image; its arrays are kept alive by the caller.
struct Field {
  DepthField field;
  std::vector<DepthLayer> layers;

  Field(const py::object& depth, const CameraTuple& camera, const std::array<int, 4>& guard,
        const std::string& kind, double near_plane, double far_plane, const py::object& normals,
        bool no_normals, const py::object& back,
        const std::vector<std::array<py::object, 2>>& given) {
    field.depth = image("depth", depth);
    const auto names = enum_names<DepthKind>();
    const auto at = std::find(names.begin(), names.end(), kind);
    if (at == names.end()) {
      throw py::value_error("depth_kind is '" + kind + "'; it must be " + one_of(names));
    }
    field.depth_kind = static_cast<DepthKind>(at - names.begin());
    field.near_plane = static_cast<float>(near_plane);
    field.far_plane = static_cast<float>(far_plane);
    field.camera = camera_of(camera);
    field.guard_band = guard_of(guard);
    field.normals = vectors("normals", normals);
    field.normal_use = no_normals ? NormalUse::kNone : NormalUse::kAuto;
    field.back_depth = image("back_depth", back);
    for (const auto& [front, behind] : given) {
      layers.push_back({image("a layer's front", front), image("a layer's back", behind)});
    }
    field.layers = layers;
    const Extent visible = field.visible();
    if (visible.width < 1 || visible.height < 1) {
      throw py::value_error("depth and guard_band leave an image of " +
                            std::to_string(visible.height) + " rows and " +
                            std::to_string(visible.width) + " columns; both must be at least 1");
    }
  }
};

Outputs outputs_of(const std::vector<std::pair<std::string, py::array>>& arrays, Extent size) {
  Outputs o;
  for (const auto& [name, array] : arrays) {
    if (name == "visibility") {
      o.visibility = image_out(name, array, size);
    } else if (name == "cone_angle") {
      o.cone_angle = image_out(name, array, size);
    } else if (name == "standard_error") {
      o.standard_error = image_out(name, array, size);
    } else if (name == "bent_normal") {
      o.bent_normal = vectors_out(name, array, size);
    } else if (name == "uniform_integral") {
      o.uniform_integral = vectors_out(name, array, size);
    } else if (name == "cosine_integral") {
      o.cosine_integral = vectors_out(name, array, size);
    } else if (name == "normal") {
      o.normal = vectors_out(name, array, size);
    } else {
      throw py::value_error("there is no output '" + name +
                            "'; there are visibility, bent_normal, cone_angle, uniform_integral, "
                            "cosine_integral, normal and standard_error");
    }
  }
  return o;
}

using NamedArrays = std::vector<std::pair<std::string, py::array>>;

void compute_once(const Field& field, const std::string& method, const Settings& settings,
                  const NamedArrays& arrays, int threads, const py::object& progress) {
  const MethodSettings s = settings_of(method, settings);
  const Outputs outputs = outputs_of(arrays, field.field.visible());
  run(threads, progress,
      [&](const RunOptions& options) { return compute(field.field, s, outputs, options); });
}

// Settings and size once, then many frames.
struct Frames {
  Estimator estimator;

  Frames(const std::string& method, const Settings& settings, int width, int height) {
    raise(Estimator::create(settings_of(method, settings), width, height, &estimator));
  }
  void run_one(const Field& field, const NamedArrays& arrays, int threads,
               const py::object& progress) {
    const Outputs outputs = outputs_of(arrays, field.field.visible());
    python::run(threads, progress, [&](const RunOptions& options) {
      return estimator.run(field.field, outputs, options);
    });
  }
};

// Summary, page and settings of every method.
py::dict methods() {
  py::dict all;
  for_each_method([&](auto info, auto settings) {
    all[info.name] = py::make_tuple(info.summary, info.page, setting_rows<decltype(settings)>());
  });
  return all;
}

// The settings of what is no method, by the name of the function that takes them.
std::map<std::string, std::vector<SettingRow>> tables() {
  return {{"terrain", setting_rows<TerrainSettings>()},
          {"sweep_distance", setting_rows<DistanceSettings>()},
          {"sweep_occlusion", setting_rows<OcclusionSettings>()},
          {"light", setting_rows<LightingSettings>()},
          {"sky", setting_rows<SkySettings>()},
          {"preconvolution", setting_rows<PreconvolutionSettings>()}};
}

}  // namespace

PYBIND11_MODULE(_library, m) {
  m.doc() = "The compiled part of obscura; use the package.";
  m.def("version", &version);
  m.def("methods", &methods);
  m.def("tables", &tables);
  m.def("perspective", [](double fov_y, int w, int h, const std::array<int, 4>& g) {
    return tuple_of(Camera::perspective(static_cast<float>(fov_y), w, h, guard_of(g)));
  });
  m.def("orthographic", [](double height, int w, int h, const std::array<int, 4>& g) {
    return tuple_of(Camera::orthographic_height(static_cast<float>(height), w, h, guard_of(g)));
  });
  m.def("from_projection",
        [](const std::array<double, 16>& matrix, int w, int h, const std::array<int, 4>& g) {
          Camera camera;
          raise(Camera::from_projection(matrix.data(), w, h, guard_of(g), &camera));
          return tuple_of(camera);
        });
  py::class_<Field>(m, "Field")
      .def(py::init<const py::object&, const CameraTuple&, const std::array<int, 4>&,
                    const std::string&, double, double, const py::object&, bool, const py::object&,
                    const std::vector<std::array<py::object, 2>>&>());
  m.def("compute", &compute_once);
  py::class_<Frames>(m, "Frames")
      .def(py::init<const std::string&, const Settings&, int, int>())
      .def("run", &Frames::run_one);
  add_light(m);
  add_terrain(m);
  add_volumes(m);
}

}  // namespace obscura::python

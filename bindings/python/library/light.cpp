// Environments, and light from visibility, bent normals and cones.
#include "library/arrays.h"
#include "library/module.h"
#include "library/run.h"
#include "library/settings.h"
#include "obscura/lighting.h"

namespace obscura::python {
namespace {

using Three = std::array<float, 3>;

// An environment, and its convolution once it has been asked for.
struct Lights {
  Environment environment;
  PreconvolvedEnvironment convolved;

  static Lights sky(const GivenSettings& given) {
    const auto settings = read_settings<SkySettings>("Environment.sky", given);
    Lights l;
    run(0, py::none(), [&](const RunOptions& options) {
      return Environment::from_sky(settings, &l.environment, options);
    });
    return l;
  }
  static Lights lat_long(const py::object& map) {
    const VectorView<const float> rgb = vectors("radiance", map);
    Lights l;
    run(0, py::none(), [&](const RunOptions& options) {
      return Environment::from_lat_long(rgb, &l.environment, nullptr, options);
    });
    return l;
  }
  Lights with_sun(const Three& direction, const Three& irradiance, float angular_radius) const {
    Lights l;
    raise(environment.with_sun({direction, irradiance, angular_radius}, &l.environment));
    return l;
  }
  void convolve(const GivenSettings& given, int threads, const py::object& progress) {
    const auto settings = read_settings<PreconvolutionSettings>("Environment.convolve", given);
    PreconvolvedEnvironment result;
    run(threads, progress, [&](const RunOptions& options) {
      return PreconvolvedEnvironment::make(environment, settings, &result, options);
    });
    convolved = std::move(result);
  }
  bool is_convolved() const { return !convolved.empty(); }
  Three radiance(const Three& direction) const { return environment.radiance(direction); }
};

void light_images(const py::object& visibility, const py::object& normal,
                  const py::object& bent_normal, const py::object& cone_angle,
                  const py::object& albedo, const Lights& lights, const GivenSettings& given,
                  const std::array<float, 9>& world_from_eye, const py::array& out, int threads,
                  const py::object& progress) {
  LightingInputs inputs;
  inputs.visibility = image("visibility", visibility);
  inputs.normal = vectors("normal", normal);
  inputs.bent_normal = vectors("bent_normal", bent_normal);
  inputs.cone_angle = image("cone_angle", cone_angle);
  inputs.albedo = vectors("albedo", albedo);
  auto settings = read_settings<LightingSettings>("light", given);
  settings.world_from_eye = world_from_eye;
  const Extent size{inputs.visibility.width, inputs.visibility.height};
  const VectorView<float> result = vectors_out("out", out, size);
  run(threads, progress, [&](const RunOptions& options) {
    return light(inputs, lights.convolved, settings, result, options);
  });
}

}  // namespace

void add_light(py::module_& m) {
  py::class_<Lights>(m, "Lights")
      .def_static("sky", &Lights::sky)
      .def_static("lat_long", &Lights::lat_long)
      .def("with_sun", &Lights::with_sun)
      .def("convolve", &Lights::convolve)
      .def("is_convolved", &Lights::is_convolved)
      .def("radiance", &Lights::radiance);
  m.def("light", &light_images);
}

}  // namespace obscura::python

// Volumes: distances, occlusion and light at points of a surface.
#include <pybind11/stl.h>

#include "library/module.h"
#include "library/run.h"
#include "library/settings.h"
#include "library/volume_arrays.h"
#include "obscura/volume.h"

namespace obscura::python {
namespace {

GridView<float> grid_out(const char* name, py::array array, const std::array<int, 3>& size) {
  const GridView<const float> g = float_grid(name, array, {1, 1, 1});
  if (g.size != size) {
    throw py::value_error(std::string(name) + " has shape " + shape_text(array) +
                          "; its volume has (" + std::to_string(size[2]) + ", " +
                          std::to_string(size[1]) + ", " + std::to_string(size[0]) + ")");
  }
  if (!array.writeable()) {
    throw py::value_error(std::string(name) + " is read-only; it must be writeable");
  }
  return {static_cast<float*>(array.mutable_data()), g.size, g.spacing, g.stride};
}

std::pair<int, bool> distances(const py::object& volume, const std::array<double, 3>& spacing,
                               double slope, double intercept, const GivenSettings& given,
                               const py::array& out, int threads, const py::object& progress) {
  const VolumeView view = volume_view(volume, spacing, slope, intercept);
  const GridView<float> distance = grid_out("out", out, view.size);
  const auto settings = read_settings<DistanceSettings>("sweep_distance", given);
  DistanceReport report;
  run(threads, progress, [&](const RunOptions& options) {
    return sweep_distance(view, settings, distance, options, &report);
  });
  return {report.sweeps, report.converged};
}

template <class T>
std::array<T, 3> turned(const std::array<T, 3>& a) {
  return {a[2], a[1], a[0]};
}

py::array_t<float> new_array(const std::vector<py::ssize_t>& shape) {
  return py::array_t<float>(shape);
}

// VisibilityField with arrays.
struct Swept {
  VisibilityField field;

  std::vector<py::ssize_t> shape() const {
    const auto n = field.size();
    return {n[2], n[1], n[0]};
  }
  std::array<float, 3> spacing() const { return turned(field.spacing()); }
  std::array<float, 3> origin() const { return turned(field.origin()); }

  py::array octant(int number) const {
    auto array = new_array(shape());
    raise(field.octant(number, grid_out("octant", array, field.size())));
    return array;
  }
  py::array scalar(int threads, const py::object& progress) const {
    auto array = new_array(shape());
    const GridView<float> view = grid_out("scalar", array, field.size());
    run(threads, progress, [&](const RunOptions& options) { return field.scalar(view, options); });
    return array;
  }
  py::array light(const py::object& positions, const py::object& normals, unsigned octants,
                  bool geometry_term, int threads, const py::object& progress) const {
    std::vector<SurfacePoint> points = surface_points(positions, normals);
    auto array = new_array({static_cast<py::ssize_t>(points.size())});
    const std::span<float> visibility(array.mutable_data(), points.size());
    run(threads, progress, [&](const RunOptions& options) {
      return field.light(points, {octants, geometry_term}, visibility, options);
    });
    return array;
  }

  static std::vector<SurfacePoint> surface_points(const py::object& positions,
                                                  const py::object& normals) {
    const py::array at = triples("points", positions), n = triples("normals", normals);
    if (at.shape(0) != n.shape(0)) {
      throw py::value_error("normals has shape " + shape_text(n) + "; points has " +
                            shape_text(at));
    }
    const auto p = py::array_t<float>(at).unchecked<2>();
    const auto q = py::array_t<float>(n).unchecked<2>();
    std::vector<SurfacePoint> points(static_cast<std::size_t>(at.shape(0)));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto k = static_cast<py::ssize_t>(i);
      points[i] = {{p(k, 0), p(k, 1), p(k, 2)}, {q(k, 0), q(k, 1), q(k, 2)}};
    }
    return points;
  }
  static py::array triples(const char* name, const py::object& object) {
    const py::array a = typed_array(name, object, "float32", "(N, 3)");
    check_float(name, a);
    if (a.ndim() != 2 || a.shape(1) != 3) {
      throw py::value_error(std::string(name) + " has shape " + shape_text(a) +
                            "; it must be (N, 3)");
    }
    return a;
  }
};

std::unique_ptr<Swept> occlusion(const py::object& distance, const std::array<double, 3>& spacing,
                                 const GivenSettings& given,
                                 const std::optional<std::array<float, 3>>& to_light, int threads,
                                 const py::object& progress) {
  const GridView<const float> view = float_grid("distance", distance, spacing);
  const auto settings =
      read_settings<OcclusionSettings>(to_light ? "sweep_shadow" : "sweep_occlusion", given);
  auto swept = std::make_unique<Swept>();
  run(threads, progress, [&](const RunOptions& options) {
    return to_light ? sweep_shadow(view, *to_light, settings, &swept->field, options)
                    : sweep_occlusion(view, settings, &swept->field, options);
  });
  return swept;
}

}  // namespace

void add_volumes(py::module_& m) {
  m.def("distances", &distances);
  m.def("occlusion", &occlusion);
  py::class_<Swept>(m, "Swept")
      .def("shape", &Swept::shape)
      .def("spacing", &Swept::spacing)
      .def("origin", &Swept::origin)
      .def("octant", &Swept::octant)
      .def("scalar", &Swept::scalar)
      .def("light", &Swept::light);
}

}  // namespace obscura::python

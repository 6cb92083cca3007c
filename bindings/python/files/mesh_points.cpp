// Ambient visibility at points of a mesh.
#include <cmath>

#include "files/module.h"
#include "library/run.h"
#include "scene/truth/mesh_points.h"
#include "scene/truth/vertex_normals.h"

namespace obscura::python {
namespace {

// The rows of an array (N, 3), one after the other.
template <class T>
std::vector<T> rows(const char* name, const py::object& object, const char* type) {
  const py::array a = typed_array(name, object, type, "(N, 3)");
  if (!a.dtype().equal(py::dtype::of<T>())) {
    throw py::type_error(std::string(name) + " is " + std::string(py::str(a.attr("dtype"))) +
                         "; it must be " + type);
  }
  if (a.ndim() != 2 || a.shape(1) != 3) {
    throw py::value_error(std::string(name) + " has shape " + shape_text(a) +
                          "; it must be (N, 3)");
  }
  const auto values = py::array_t<T>(a).template unchecked<2>();
  std::vector<T> all;
  all.reserve(static_cast<std::size_t>(a.size()));
  for (py::ssize_t i = 0; i < a.shape(0); ++i) {
    for (py::ssize_t k = 0; k < 3; ++k) all.push_back(values(i, k));
  }
  return all;
}

tools::Mesh mesh_of(const std::vector<float>& vertices, const std::vector<std::uint32_t>& faces) {
  tools::Mesh mesh;
  for (std::size_t i = 0; i < vertices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!std::isfinite(vertices[i + k])) {
        throw py::value_error("vertex " + std::to_string(i / 3) + " is not finite");
      }
    }
    mesh.positions.push_back({vertices[i], vertices[i + 1], vertices[i + 2]});
  }
  for (std::size_t i = 0; i < faces.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (faces[i + k] >= mesh.positions.size()) {
        throw py::value_error("face " + std::to_string(i / 3) + " names vertex " +
                              std::to_string(faces[i + k]) + "; there are " +
                              std::to_string(mesh.positions.size()));
      }
    }
    mesh.triangles.push_back({faces[i], faces[i + 1], faces[i + 2]});
  }
  if (mesh.triangles.empty()) throw py::value_error("faces is empty; a mesh has triangles");
  mesh.parts = {{0, mesh.triangles.size(), false}};
  return mesh;
}

// (visibility (N,), bent normals (N, 3) or None); without points of the vertices.
py::tuple points_of_mesh(const py::object& vertices, const py::object& faces,
                         const py::object& positions, const py::object& normals, bool bent,
                         const GivenSettings& given, int threads, const py::object& progress) {
  tools::Mesh mesh = mesh_of(rows<float>("vertices", vertices, "float32"),
                             rows<std::uint32_t>("faces", faces, "uint32"));
  std::vector<float> at, n;
  if (positions.is_none()) {
    for (const auto& p : mesh.positions) at.insert(at.end(), {p.x, p.y, p.z});
    std::size_t without = 0;
    n = tools::vertex_normals(mesh, &without);
  } else {
    at = rows<float>("points", positions, "float32");
    n = rows<float>("normals", normals, "float32");
  }
  const auto settings = read_settings<tools::MeshPointSettings>("mesh_visibility", given);
  std::vector<float> visibility(at.size() / 3), directions(bent ? at.size() : 0);
  run(threads, progress, [&](const RunOptions& options) {
    std::unique_ptr<tools::RayScene> scene;
    if (Status s = tools::RayScene::create(std::move(mesh), &scene, options.threads); !s.ok()) {
      return s;
    }
    return tools::trace_points(*scene, {at, n}, settings, {visibility, directions}, options);
  });
  const auto count = static_cast<py::ssize_t>(visibility.size());
  if (!bent) return py::make_tuple(to_array(visibility, {count}), py::none());
  return py::make_tuple(to_array(visibility, {count}), to_array(directions, {count, 3}));
}

}  // namespace

void add_mesh_points(py::module_& m) {
  m.def("points_of_mesh", &points_of_mesh);
  m.def("mesh_point_settings", &setting_rows<tools::MeshPointSettings>);
}

}  // namespace obscura::python

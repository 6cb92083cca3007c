// What a camera sees of a mesh or scene, depth files, and the truth of the geometry.
#include "files/module.h"
#include "io/images/depth_file.h"
#include "library/run.h"
#include "scene/scenes/mesh_view.h"
#include "scene/truth/geometric.h"

namespace obscura::python {
namespace {

// A depth image, and where it was rendered here, the scene behind it.
struct Seen {
  tools::Rendering rendering;

  const tools::DepthInput& input() const { return rendering.gbuffer; }
  std::vector<py::ssize_t> shape() const { return {input().height, input().width}; }

  py::object image_of(const std::vector<float>& values) const {
    if (values.empty()) return py::none();
    return to_array(values, shape());
  }
  py::object depth() const { return image_of(input().depth); }
  py::object back_depth() const { return image_of(input().back_depth); }
  py::object normals() const {
    const tools::DepthInput& g = input();
    if (g.normal_x.empty()) return py::none();
    py::array_t<float> array({shape()[0], shape()[1], py::ssize_t{3}});
    float* at = array.mutable_data();
    for (std::size_t i = 0; i < g.normal_x.size(); ++i) {
      *at++ = g.normal_x[i];
      *at++ = g.normal_y[i];
      *at++ = g.normal_z[i];
    }
    return array;
  }
  std::vector<std::pair<py::object, py::object>> layers() const {
    std::vector<std::pair<py::object, py::object>> all;
    for (const auto& l : input().layers) all.emplace_back(image_of(l.front), image_of(l.back));
    return all;
  }
  std::tuple<bool, double, double, double, double> camera() const {
    const Camera& c = input().camera;
    return {c.orthographic, c.scale_x, c.scale_y, c.center_u, c.center_v};
  }
  std::array<int, 4> guard_band() const {
    const GuardBand& g = input().guard_band;
    return {g.left, g.right, g.top, g.bottom};
  }
  std::tuple<std::string, double, double> kind() const {
    return {enum_name(input().depth_kind), input().near_plane, input().far_plane};
  }
  std::vector<std::string> notes() const { return input().notes; }
  // Row-major rotation from eye space to the world; the identity where it is not known.
  std::array<double, 9> world_from_eye() const {
    if (!rendering.scene) return {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const tools::Frame f = rendering.view.frame();
    return {f.x.x, f.y.x, f.z.x, f.x.y, f.y.y, f.z.y, f.x.z, f.y.z, f.z.z};
  }

  void truth(const GivenSettings& given, const std::vector<std::pair<std::string, py::array>>& out,
             int threads, const py::object& progress) const {
    if (!rendering.scene) {
      throw py::value_error(
          "truth() is of meshes and scenes; of a depth image there is "
          "visibility(method='ray-traced')");
    }
    const auto settings = read_settings<tools::GeometricSettings>("truth", given);
    const Extent size{rendering.view.width, rendering.view.height};
    Outputs outputs;
    for (const auto& [name, array] : out) {
      if (name == "visibility") {
        outputs.visibility = image_out(name, array, size);
      } else if (name == "cone_angle") {
        outputs.cone_angle = image_out(name, array, size);
      } else if (name == "standard_error") {
        outputs.standard_error = image_out(name, array, size);
      } else if (name == "bent_normal") {
        outputs.bent_normal = vectors_out(name, array, size);
      } else {
        throw py::value_error("there is no output '" + name +
                              "' of truth(); there are visibility, "
                              "bent_normal, cone_angle and standard_error");
      }
    }
    run(threads, progress, [&](const RunOptions& options) {
      return tools::trace_geometric(rendering, settings, outputs, options);
    });
  }
};

// A view of a mesh file or a procedural scene.
std::unique_ptr<Seen> see_file(const std::string& spec, const GivenSettings& given, int threads) {
  auto options = read_settings<tools::MeshOptions>("gbuffer", given);
  auto seen = std::make_unique<Seen>();
  run(threads, py::none(), [&](const RunOptions& with) {
    const auto executor = make_executor(with.threads);
    return tools::is_scene(spec)
               ? tools::load_scene(spec, options.view, *executor, &seen->rendering)
               : tools::load_mesh(spec, options, *executor, &seen->rendering);
  });
  return seen;
}

std::unique_ptr<Seen> read_depth(const std::string& path, const GivenSettings& given) {
  const auto options = read_settings<tools::DepthFileOptions>("read_depth", given);
  auto seen = std::make_unique<Seen>();
  run(1, py::none(), [&](const RunOptions&) {
    return tools::load_depth_input(path, options, &seen->rendering.gbuffer);
  });
  return seen;
}

// (vertices, faces): float32 (N, 3) in the world less `origin`, uint32 (M, 3).
py::tuple read_mesh(const std::string& path) {
  tools::Mesh mesh;
  run(1, py::none(), [&](const RunOptions&) { return tools::load_mesh(path, &mesh); });
  py::array_t<float> vertices({static_cast<py::ssize_t>(mesh.positions.size()), py::ssize_t{3}});
  float* at = vertices.mutable_data();
  for (const auto& p : mesh.positions) {
    *at++ = p.x;
    *at++ = p.y;
    *at++ = p.z;
  }
  py::array_t<std::uint32_t> faces(
      {static_cast<py::ssize_t>(mesh.triangles.size()), py::ssize_t{3}});
  std::uint32_t* to = faces.mutable_data();
  for (const auto& t : mesh.triangles) {
    *to++ = t.a;
    *to++ = t.b;
    *to++ = t.c;
  }
  return py::make_tuple(vertices, faces,
                        py::make_tuple(mesh.origin.x, mesh.origin.y, mesh.origin.z));
}

}  // namespace

void add_views(py::module_& m) {
  py::class_<Seen>(m, "Seen")
      .def("depth", &Seen::depth)
      .def("back_depth", &Seen::back_depth)
      .def("normals", &Seen::normals)
      .def("layers", &Seen::layers)
      .def("camera", &Seen::camera)
      .def("guard_band", &Seen::guard_band)
      .def("kind", &Seen::kind)
      .def("notes", &Seen::notes)
      .def("world_from_eye", &Seen::world_from_eye)
      .def("truth", &Seen::truth);
  m.def("see_file", &see_file);
  m.def("read_depth", &read_depth);
  m.def("read_mesh", &read_mesh);
  m.def("view_settings", &setting_rows<tools::MeshOptions>);
  m.def("truth_settings", &setting_rows<tools::GeometricSettings>);
  m.def("depth_file_settings", &setting_rows<tools::DepthFileOptions>);
}

}  // namespace obscura::python

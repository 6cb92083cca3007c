#include "apps/obscura/input.h"

#include <algorithm>
#include <cmath>

#include "fmt/format.h"
#include "io/images/depth_file.h"
#include "scene/scenes/mesh_view.h"

namespace obscura::app {
namespace {

constexpr const char* kImages = "depth images";
constexpr const char* kScenes = "scenes";
constexpr const char* kMeshes = "meshes";

// `normals` of a rendered input; that of a file names channels too.
struct RenderedNormals {
  std::string normals = "auto";
};
template <FieldsOf<RenderedNormals> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.normals, Field{"normals", "", {}, "auto (the geometry's), depth (from depth) or none."});
}

}  // namespace

DepthField LoadedInput::field() const {
  DepthField field = rendering.gbuffer.field();
  field.normal_use = normal_use;
  return field;
}

void InputOptions::add_to(CLI::App* command) {
  command
      ->add_option("INPUT", path_,
                   "Depth image (.exr, .pfm, 16-bit .png), mesh (.obj, .ply, .gltf, .glb, also "
                   ".gz) or scene (scene:NAME?key=value&...)")
      ->required()
      ->type_name("");
  table_.declare(kImages, tools::DepthFileOptions{});
  table_.declare(kScenes, tools::ViewOptions{});
  table_.declare(kScenes, RenderedNormals{});
  table_.declare(kMeshes, tools::MeshOptions{});
  table_.declare(kMeshes, RenderedNormals{});
  table_.add_to(command, "Input");
}

Status InputOptions::load(const std::string& path, const tools::ProjectionMatrix* projection,
                          const LayerNeeds& needs, int threads, LoadedInput* input) const {
  if (tools::is_scene(path) || tools::is_mesh(path)) {
    if (!projection) return render(path, needs, threads, input);
    return invalid_argument(
        fmt::format("--cameras holds the cameras of depth images; {} is none", path));
  }
  if (Status s = table_.refuse_others(kImages, "a depth image"); !s.ok()) return s;
  tools::DepthFileOptions options;
  if (Status s = table_.read(&options); !s.ok()) return s;
  options.layers = needs.given ? static_cast<int>(Occluder::kLayersRange.max) : needs.layers;
  input->normal_use = options.normals == "none" ? NormalUse::kNone : NormalUse::kAuto;
  if (projection) options.projection_matrix = *projection;
  if (Status s = tools::load_depth_input(path, options, &input->rendering.gbuffer); !s.ok()) {
    return s;
  }
  for (const std::string& note : input->rendering.gbuffer.notes) {
    fmt::print(stderr, "obscura: note: {}\n", note);
  }
  return {};
}

Status InputOptions::render(const std::string& path, const LayerNeeds& needs, int threads,
                            LoadedInput* input) const {
  const bool scene = tools::is_scene(path);
  if (Status s = table_.refuse_others(scene ? kScenes : kMeshes, path); !s.ok()) return s;
  RenderedNormals normals;
  if (Status s = table_.read(&normals); !s.ok()) return s;
  const std::string& use = normals.normals;
  if (use != "auto" && use != "depth" && use != "none") {
    return invalid_argument(
        fmt::format("--normals is '{}'; it must be auto, depth or none for a scene or mesh", use));
  }
  tools::MeshOptions options;
  if (Status s = table_.read(&options); !s.ok()) return s;
  options.view.back_depth = options.view.back_depth || needs.back_depth;
  options.view.layers = std::max(options.view.layers, needs.layers);

  const auto executor = make_executor(threads);
  tools::Rendering* rendering = &input->rendering;
  const Status s = scene ? tools::load_scene(path, options.view, *executor, rendering)
                         : tools::load_mesh(path, options, *executor, rendering);
  if (!s.ok()) return s;
  for (const std::string& note : rendering->scene->mesh().notes) {
    fmt::print(stderr, "obscura: note: {}\n", note);
  }
  tools::DepthInput& gbuffer = rendering->gbuffer;
  gbuffer.name = path;
  if (std::ranges::none_of(gbuffer.depth, [](float depth) { return std::isfinite(depth); })) {
    fmt::print(stderr,
               "obscura: note: the picture shows nothing of {}; --eye and --look-at say where the "
               "camera stands and looks\n",
               path);
  }
  if (use == "none") input->normal_use = NormalUse::kNone;
  if (use == "depth") {
    for (auto* n : {&gbuffer.normal_x, &gbuffer.normal_y, &gbuffer.normal_z}) n->clear();
  }
  return {};
}

}  // namespace obscura::app

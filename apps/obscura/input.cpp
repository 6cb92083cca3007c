#include "apps/obscura/input.h"

#include <algorithm>

#include "fmt/format.h"
#include "support/files/depth_file.h"

namespace obscura::app {
namespace {

constexpr const char* kImages = "depth images";
constexpr const char* kGeometry = "scenes and meshes";

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
  table_.declare(kImages, support::DepthFileOptions{});
  table_.declare(kGeometry, support::ViewOptions{});
  table_.declare(kGeometry, RenderedNormals{});
  table_.add_to(command, "Input");
}

Status InputOptions::load(const LayerNeeds& needs, int threads, LoadedInput* input) const {
  if (support::is_scene(path_)) {
    if (Status s = table_.refuse_others(kGeometry, path_); !s.ok()) return s;
    support::ViewOptions options;
    if (Status s = table_.read(&options); !s.ok()) return s;
    options.back_depth = options.back_depth || needs.back_depth;
    options.layers = std::max(options.layers, needs.layers);
    RenderedNormals normals;
    if (Status s = table_.read(&normals); !s.ok()) return s;
    const std::string& use = normals.normals;
    if (use != "auto" && use != "depth" && use != "none") {
      return invalid_argument(fmt::format(
          "--normals is '{}'; it must be auto, depth or none for a scene or mesh", use));
    }
    const auto executor = make_executor(threads);
    support::DepthInput& gbuffer = input->rendering.gbuffer;
    if (Status s = support::load_scene(path_, options, *executor, &input->rendering); !s.ok()) {
      return s;
    }
    gbuffer.name = path_;
    if (use == "none") input->normal_use = NormalUse::kNone;
    if (use == "depth") {
      for (auto* n : {&gbuffer.normal_x, &gbuffer.normal_y, &gbuffer.normal_z}) n->clear();
    }
    return {};
  }
  if (Status s = table_.refuse_others(kImages, "a depth image"); !s.ok()) return s;
  support::DepthFileOptions options;
  if (Status s = table_.read(&options); !s.ok()) return s;
  input->normal_use = options.normals == "none" ? NormalUse::kNone : NormalUse::kAuto;
  return support::load_depth_input(path_, options, &input->rendering.gbuffer);
}

}  // namespace obscura::app

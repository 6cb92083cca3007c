#include "scene/scenes/load_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "scene/scenes/scene.h"

namespace obscura::tools {
namespace {

constexpr std::string_view kPrefix = "scene:";

struct SeedOption {
  std::uint32_t seed = 1;
};
template <FieldsOf<SeedOption> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.seed, Field{"seed", "", anything(), "Seed of the random numbers."});
}

Status find_kind(const std::string& name, const SceneKind** kind) {
  std::string names;
  for (const SceneKind& k : scene_catalogue()) {
    if (k.name == name) {
      *kind = &k;
      return {};
    }
    names += (names.empty() ? "" : ", ") + k.name;
  }
  return invalid_argument(fmt::format("there is no scene \"{}\"; the scenes are {}", name, names));
}

Status check_keys(const std::string& spec, const SceneKind& kind,
                  const SceneParameters& parameters) {
  std::vector<std::string> known;
  for (const auto& p : kind.parameters) known.push_back(p.key);
  for (const auto& p : describe_fields<ViewOptions>()) known.push_back(p.key);
  for (const auto& p : describe_fields<SeedOption>()) known.push_back(p.key);
  for (const auto& [key, value] : parameters) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      return invalid_argument(fmt::format("{}: there is no key \"{}\"; {} has {}", spec, key,
                                          kind.name, fmt::join(known, ", ")));
    }
  }
  return {};
}

Status build_and_render(const std::string& spec, const ViewOptions& given, Executor& executor,
                        Rendering* rendering) {
  auto named = [&](const Status& s) {
    return s.ok() ? s : Status(s.code(), fmt::format("{}: {}", spec, s.message()));
  };
  std::string name;
  SceneParameters parameters;
  const SceneKind* kind = nullptr;
  if (Status s = split_scene(spec, &name, &parameters); !s.ok()) return s;
  if (Status s = find_kind(name, &kind); !s.ok()) return s;
  if (Status s = check_keys(spec, *kind, parameters); !s.ok()) return s;
  ViewOptions options = given;
  SeedOption seed;
  if (Status s = read_fields(parameters, &options); !s.ok()) return named(s);
  if (Status s = read_fields(parameters, &seed); !s.ok()) return named(s);
  Scene scene;
  if (Status s = kind->build(parameters, seed.seed, &scene); !s.ok()) return named(s);
  if (Status s = apply_options(options, &scene.view); !s.ok()) return named(s);
  LayerSpec layers = options.layer_spec();
  if (layers.sheet_thickness == 0) layers.sheet_thickness = scene.sheet_thickness;
  std::unique_ptr<RayScene> rays;
  if (Status s = RayScene::create(std::move(scene.mesh), &rays, executor.thread_count()); !s.ok())
    return named(s);
  DepthInput gbuffer;
  gbuffer.name = spec;
  Status s = render_gbuffer(*rays, scene.view, layers, executor, &gbuffer);
  if (!s.ok()) return named(s);
  *rendering = {std::move(rays), scene.view, std::move(gbuffer)};
  return {};
}

}  // namespace

Status split_scene(const std::string& spec, std::string* name, SceneParameters* parameters) {
  std::string_view rest = std::string_view(spec).substr(kPrefix.size());
  const std::size_t question = rest.find('?');
  *name = rest.substr(0, question);
  if (question == std::string_view::npos) return {};
  rest.remove_prefix(question + 1);
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos || equals == 0) {
      return invalid_argument(fmt::format("{}: \"{}\" is not of the form key=value", spec, pair));
    }
    const std::string key(pair.substr(0, equals));
    if (!parameters->emplace(key, pair.substr(equals + 1)).second) {
      return invalid_argument(fmt::format("{}: {} is given twice", spec, key));
    }
  }
  return {};
}

bool is_scene(const std::string& spec) { return spec.starts_with(kPrefix); }

Status load_scene(const std::string& spec, const ViewOptions& options, Executor& executor,
                  Rendering* rendering) {
  if (!is_scene(spec)) {
    return invalid_argument(fmt::format("\"{}\" is not a scene; write scene:NAME", spec));
  }
  try {
    return build_and_render(spec, options, executor, rendering);
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, spec + ": out of memory"};
  }
}

Status load_scene(const std::string& spec, DepthInput* input) {
  const auto executor = make_executor();
  Rendering rendering;
  if (Status s = load_scene(spec, {}, *executor, &rendering); !s.ok()) return s;
  *input = std::move(rendering.gbuffer);
  return {};
}

}  // namespace obscura::tools

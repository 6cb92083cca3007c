#include "apps/obscura/methods.h"

#include "apps/obscura/choices.h"
#include "fmt/format.h"

namespace obscura::app {
namespace {

// Calls f with whichever settings struct it is.
template <class Settings, class F>
decltype(auto) visit_settings(Settings& settings, F&& f) {
  return std::visit(
      [&](auto& s) -> decltype(auto) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(s)>, MethodSettings>) {
          return std::visit(f, s);
        } else {
          return f(s);
        }
      },
      settings);
}

std::vector<MethodEntry> list_methods() {
  std::vector<MethodEntry> list;
  auto add = [&](auto info, AnySettings defaults) {
    list.push_back({info.name, info.summary, info.page, info.on_vulkan, std::move(defaults)});
  };
  for_each_method([&](auto info, const auto& defaults) { add(info, MethodSettings(defaults)); });
  add(MethodInfo<tools::GeometricSettings>(), tools::GeometricSettings{});
  return list;
}

}  // namespace

const std::vector<MethodEntry>& methods() {
  static const std::vector<MethodEntry> list = list_methods();
  return list;
}

std::string method_names() {
  std::string names;
  for (const MethodEntry& m : methods()) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", m.name);
  }
  return names;
}

AnySettings default_settings(const std::string& method) {
  for (const MethodEntry& m : methods()) {
    if (method == m.name) return m.defaults;
  }
  return {};
}

void set_radius(float radius, AnySettings* settings) {
  visit_settings(*settings, [&](auto& s) { s.falloff.radius = radius; });
}

void MethodOptions::add_to(CLI::App* command, const std::string& default_method) {
  method_ = default_method;
  CLI::Option* method =
      command
          ->add_option("--method", method_,
                       fmt::format("Estimator: {} [default {}]", method_names(), default_method))
          ->type_name("NAME");
  set_choices(method, method_names());
  for (const MethodEntry& m : methods()) {
    visit_settings(m.defaults, [&](const auto& s) { table_.declare(m.name, s); });
  }
  table_.add_to(command, "Method settings");
}

Status MethodOptions::settings(AnySettings* settings) const {
  for (const MethodEntry& m : methods()) {
    if (method_ != m.name) continue;
    if (Status s = table_.refuse_others(method_, "--method " + method_); !s.ok()) return s;
    AnySettings result = m.defaults;
    const Status status = visit_settings(result, [&](auto& s) { return table_.read(&s); });
    if (status.ok()) *settings = std::move(result);
    return status;
  }
  return invalid_argument(
      fmt::format("--method is '{}'; it must be one of {}", method_, method_names()));
}

LayerNeeds layer_needs(const AnySettings& settings) {
  return visit_settings(settings, [](const auto& s) {
    LayerNeeds needs;
    if constexpr (requires { s.occluder; }) {
      needs.back_depth = s.occluder.kind == OccluderKind::kBackDepth;
      needs.layers = s.occluder.kind == OccluderKind::kLayers ? s.occluder.layers : 0;
      needs.given = s.occluder.kind == OccluderKind::kAuto;
    }
    return needs;
  });
}

std::string occluder_text(const AnySettings& settings, const DepthField& field) {
  return visit_settings(settings, [&](const auto& s) -> std::string {
    if constexpr (requires { s.occluder; }) {
      using Info = MethodInfo<std::remove_cvref_t<decltype(s)>>;
      const std::string text = write_setting(s.occluder);
      if (s.occluder.kind != OccluderKind::kAuto) return text;
      if constexpr (requires { Info::takes_layers; }) {
        if (Info::takes_layers && !field.layers.empty()) return text + ", from layers";
      }
      const bool given = !field.back_depth.empty() || !field.layers.empty();
      return text + (given ? ", from back depth" : ", from widths");
    }
    return {};
  });
}

Status run_method(const AnySettings& settings, const LoadedInput& input, const Outputs& outputs,
                  const RunOptions& options, MadeOnce* once) {
  if (const auto* geometric = std::get_if<tools::GeometricSettings>(&settings)) {
    if (!input.rendering.scene) {
      return invalid_argument(fmt::format(
          "--method geometric needs a scene or mesh; {} is a depth image", input.depth().name));
    }
    return tools::trace_geometric(input.rendering, *geometric, outputs, options);
  }
  const int width = input.depth().width, height = input.depth().height;
  Status status;
  if (once->width != width || once->height != height) {
    status = Estimator::create(std::get<MethodSettings>(settings), width, height, &once->estimator);
    once->width = status.ok() ? width : 0;
    once->height = status.ok() ? height : 0;
  }
  if (status.ok()) status = once->estimator.run(input.field(), outputs, options);
  // The library knows no file names.
  if (status.code() == StatusCode::kInvalidInput) {
    return {status.code(), fmt::format("{}: {}", input.depth().name, status.message())};
  }
  return status;
}

tools::Json to_json(const AnySettings& settings) {
  tools::Json json = tools::Json::object();
  visit_settings(settings, [&](const auto& s) {
    visit_fields(s, [&](const auto& value, const Field& field) {
      using T = std::remove_cvref_t<decltype(value)>;
      if constexpr (std::is_arithmetic_v<T>) {
        json[field.name] = value;
      } else {
        json[field.name] = write_setting(value);
      }
    });
  });
  return json;
}

std::string settings_markdown() {
  std::string out =
      "# Settings\n\n"
      "The settings of every method. The names are those of C++; on the command line they are "
      "`--name` with `-` "
      "for `_`.\nMade by `obscura settings`; a test compares this page with the library.\n";
  for (const MethodEntry& m : methods()) {
    const std::string page = m.page + std::string_view("docs/").size();  // from this page
    out += fmt::format("\n## {}\n\n{} ([page]({})).{}\n\n", m.name, m.summary, page,
                       m.on_vulkan ? " Also on Vulkan." : "");
    out += "| field | meaning | value | unit | default |\n";
    out += "|---|---|---|---|---|\n";
    visit_settings(m.defaults, [&](const auto& s) {
      visit_fields(s, [&](const auto& value, const Field& field) {
        using T = std::remove_cvref_t<decltype(value)>;
        out += fmt::format("| `{}` | {} | {} | {} | {} |\n", field.name, field.help,
                           expected_text<T>(field), field.unit, write_setting(value));
      });
    });
  }
  return out;
}

}  // namespace obscura::app

#include "apps/obscura/methods.h"

#include "fmt/format.h"

namespace obscura::app {

const std::vector<MethodEntry>& methods() {
  static const std::vector<MethodEntry> list = {
      {"line", "Volumetric obscurance by line samples (Loos and Sloan 2010)", LineSettings{}},
  };
  return list;
}

std::string method_names() {
  std::string names;
  for (const MethodEntry& m : methods()) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", m.name);
  }
  return names;
}

void MethodOptions::add_to(CLI::App* command, const std::string& default_method) {
  method_ = default_method;
  command
      ->add_option("--method", method_,
                   fmt::format("Estimator: {} [default {}]", method_names(), default_method))
      ->type_name("NAME");
  for (const MethodEntry& m : methods()) {
    std::visit([&](const auto& s) { table_.declare(m.name, s); }, m.defaults);
  }
  table_.add_to(command, "Method settings");
}

Status MethodOptions::settings(MethodSettings* settings) const {
  for (const MethodEntry& m : methods()) {
    if (method_ != m.name) continue;
    if (Status s = table_.refuse_others(method_, "--method " + method_); !s.ok()) return s;
    MethodSettings result = m.defaults;
    const Status status = std::visit([&](auto& s) { return table_.read(&s); }, result);
    if (status.ok()) *settings = std::move(result);
    return status;
  }
  return invalid_argument(
      fmt::format("--method is '{}'; it must be one of {}", method_, method_names()));
}

LayerNeeds layer_needs(const MethodSettings& settings) {
  return std::visit(
      [](const auto& s) {
        const Occluder& o = s.occluder;
        return LayerNeeds{.back_depth = o.kind == OccluderKind::kBackDepth,
                          .layers = o.kind == OccluderKind::kLayers ? o.layers : 0};
      },
      settings);
}

Status run_method(const MethodSettings& settings, const LoadedInput& input, int threads,
                  const Outputs& outputs, const RunOptions& options) {
  DepthField field = input.depth.field();
  field.normal_use = input.normal_use;
  Estimator estimator;
  Status status =
      Estimator::create(settings, input.depth.width, input.depth.height, threads, &estimator);
  if (status.ok()) status = estimator.run(field, outputs, options);
  // The library knows no file names.
  if (status.code() == StatusCode::kInvalidInput) {
    return {status.code(), fmt::format("{}: {}", input.depth.name, status.message())};
  }
  return status;
}

nlohmann::ordered_json to_json(const MethodSettings& settings) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  std::visit(
      [&](const auto& s) {
        visit_fields(s, [&](const auto& value, const Field& field) {
          using T = std::remove_cvref_t<decltype(value)>;
          if constexpr (std::is_arithmetic_v<T>) {
            json[field.name] = value;
          } else {
            json[field.name] = write_setting(value);
          }
        });
      },
      settings);
  return json;
}

std::string settings_markdown() {
  std::string out =
      "# Settings\n\n"
      "Every method's fields: in C++ by the name given, on the command line as `--name` with `-` "
      "for `_`.\nMade by `obscura settings`; a test keeps this page and the library in step.\n";
  for (const MethodEntry& m : methods()) {
    out += fmt::format("\n## {}\n\n{}.\n\n| field | meaning | value | unit | default |\n", m.name,
                       m.summary);
    out += "|---|---|---|---|---|\n";
    std::visit(
        [&](const auto& s) {
          visit_fields(s, [&](const auto& value, const Field& field) {
            using T = std::remove_cvref_t<decltype(value)>;
            out += fmt::format("| `{}` | {} | {} | {} | {} |\n", field.name, field.help,
                               expected_text<T>(field), field.unit, write_setting(value));
          });
        },
        m.defaults);
  }
  return out;
}

}  // namespace obscura::app

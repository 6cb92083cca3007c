#include "apps/obscura/methods.h"

#include <algorithm>

#include "fmt/format.h"

namespace obscura::app {
namespace {

std::string option_name(const char* field) {
  std::string name = field;
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

// Calls visit(value, field) for every field of whichever settings struct it is.
template <class Settings, class Visitor>
void visit_any(Settings& settings, Visitor&& visitor) {
  std::visit([&](auto& s) { visit_fields(s, visitor); }, settings);
}

// One option's help: what it is, what it may be, and its default per method.
struct Help {
  std::string sentence, expected, unit;
  bool flag = false;
  std::vector<std::pair<std::string, std::string>> defaults;  // text, methods

  void add(const std::string& method, const std::string& value) {
    for (auto& [text, names] : defaults) {
      if (text == value) {
        names += ", " + method;
        return;
      }
    }
    defaults.emplace_back(value, method);
  }
  std::string text(std::size_t method_count) const {
    std::string out = sentence + " [" + expected;
    if (!unit.empty()) out += ", " + unit;
    out += "; default ";
    for (std::size_t i = 0; i < defaults.size(); ++i) {
      out += (i ? "; " : "") + defaults[i].first;
      if (defaults.size() > 1 || method_count < methods().size()) {
        out += " (" + defaults[i].second + ")";
      }
    }
    return out + "]";
  }
};

}  // namespace

const std::vector<MethodEntry>& methods() {
  static const std::vector<MethodEntry> list = {
      {"line", "volumetric obscurance by line samples (Loos and Sloan 2010)", LineSettings{}},
  };
  return list;
}

std::string method_names() {
  std::string names;
  for (const MethodEntry& m : methods())
    names += fmt::format("{}{}", names.empty() ? "" : ", ", m.name);
  return names;
}

const MethodEntry* find_method(const std::string& name) {
  for (const MethodEntry& m : methods()) {
    if (name == m.name) return &m;
  }
  return nullptr;
}

void MethodOptions::add_to(CLI::App* command, const std::string& default_method) {
  method_ = default_method;
  command->add_option("--method", method_,
                      fmt::format("Estimator: {} [default {}]", method_names(), default_method));
  std::vector<std::string> order;
  std::map<std::string, Help> help;
  for (const MethodEntry& m : methods()) {
    visit_any(m.defaults, [&](const auto& value, const Field& field) {
      using T = std::remove_cvref_t<decltype(value)>;
      Option& option = options_[field.name];
      Help& h = help[field.name];
      if (option.methods.empty()) {
        order.push_back(field.name);
        h.sentence = field.help;
        h.expected = expected_text<T>(field);
        h.unit = field.unit;
        h.flag = std::is_same_v<T, bool>;
      }
      option.methods.push_back(m.name);
      h.add(m.name, write_setting(value));
    });
  }
  for (const std::string& field : order) {
    Option& option = options_[field];
    const std::string name = option_name(field.c_str());
    const std::string text = help[field].text(option.methods.size());
    option.option = help[field].flag
                        ? command->add_flag(fmt::format("--{0},!--no-{0}", name), option.text, text)
                        : command->add_option("--" + name, option.text, text)->type_name("");
    option.option->group("Method settings");
  }
}

Status MethodOptions::settings(MethodSettings* settings) const {
  const MethodEntry* entry = find_method(method_);
  if (!entry) {
    return invalid_argument(
        fmt::format("--method is '{}'; it must be one of {}", method_, method_names()));
  }
  MethodSettings result = entry->defaults;
  for (const auto& [field, option] : options_) {
    const auto& names = option.methods;
    if (option.option->count() > 0 &&
        std::find(names.begin(), names.end(), method_) == names.end()) {
      return invalid_argument(fmt::format("--{} does not apply to --method {}; it belongs to {}",
                                          option_name(field.c_str()), method_,
                                          fmt::join(names, ", ")));
    }
  }
  Status status;
  visit_any(result, [&](auto& value, const Field& field) {
    const Option& option = options_.at(field.name);
    if (!status.ok() || option.option->count() == 0) return;
    status = parse_setting("--" + option_name(field.name), field, option.text, &value);
  });
  if (status.ok()) *settings = std::move(result);
  return status;
}

nlohmann::ordered_json to_json(const MethodSettings& settings) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  visit_any(settings, [&](const auto& value, const Field& field) {
    using T = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_arithmetic_v<T>) {
      json[field.name] = value;
    } else {
      json[field.name] = write_setting(value);
    }
  });
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
    visit_any(m.defaults, [&](const auto& value, const Field& field) {
      using T = std::remove_cvref_t<decltype(value)>;
      out += fmt::format("| `{}` | {} | {} | {} | {} |\n", field.name, field.help,
                         expected_text<T>(field), field.unit, write_setting(value));
    });
  }
  return out;
}

}  // namespace obscura::app

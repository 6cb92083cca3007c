#ifndef OBSCURA_APPS_OBSCURA_OPTION_TABLE_H_
#define OBSCURA_APPS_OBSCURA_OPTION_TABLE_H_

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "CLI/CLI.hpp"
#include "obscura/settings.h"

namespace obscura::app {

// "near_step" as the command line has it: "near-step".
std::string option_name(std::string field);

// Command-line options made from tables of settings. Several structs, each under a label (a method,
// a kind of input), may share an option by using one name for a field.
class OptionTable {
 public:
  // Takes in the fields of a struct, with its values as the defaults.
  template <class Settings>
  void declare(const std::string& label, const Settings& defaults) {
    if (std::find(labels_.begin(), labels_.end(), label) == labels_.end()) labels_.push_back(label);
    visit_fields(defaults, [&](const auto& value, const Field& field) {
      using T = std::remove_cvref_t<decltype(value)>;
      declare_field(
          label, field, expected_text<T>(field), write_setting(value), std::is_same_v<T, bool>,
          requires { SettingText<T>::repeatable; });
    });
  }

  // Adds one option per field, once all structs are declared.
  void add_to(CLI::App* command, const std::string& group);

  // Fails where an option was given that the struct under `label` does not have. `what` names it in
  // the message: "--method line".
  Status refuse_others(const std::string& label, const std::string& what) const;

  // Lays the options that were given over the fields of a struct. `--radius R1,R2` is short for
  // `--radius R1 --second-radius R2` where there are two.
  template <class Settings>
  Status read(Settings* settings) const {
    Status status;
    visit_fields(*settings, [&](auto& value, const Field& field) {
      if (!status.ok()) return;
      const std::string name = field.name;
      if constexpr (requires { settings->dual; }) {
        const auto radius = options_.find("radius");
        const bool both = radius != options_.end() && radius->second.option->count() > 0;
        const std::string text = both ? radius->second.text : "";
        const std::size_t comma = text.find(',');
        if (comma != text.npos && (name == "radius" || name == "second_radius")) {
          const std::string part =
              name == "radius" ? text.substr(0, comma) : text.substr(comma + 1);
          status = parse_setting("--radius", field, part, &value);
          return;
        }
      }
      const auto at = options_.find(name);
      if (at == options_.end() || at->second.option->count() == 0) return;
      status = parse_setting("--" + option_name(name), field, at->second.text, &value);
    });
    return status;
  }

  bool given(const std::string& field) const;

 private:
  struct Option {
    CLI::Option* option = nullptr;
    std::string text;
    std::vector<std::string> labels;
    std::string help, expected, unit;
    std::vector<std::string> words;  // of enumerations
    bool flag = false, repeatable = false;
    std::vector<std::pair<std::string, std::string>> defaults;  // value, labels
  };

  void declare_field(const std::string& label, const Field& field, const std::string& expected,
                     const std::string& default_value, bool flag, bool repeatable);
  std::string help_text(const Option& option) const;

  std::vector<std::string> labels_;
  std::vector<std::string> order_;
  std::map<std::string, Option> options_;  // by C++ field name
};

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_OPTION_TABLE_H_

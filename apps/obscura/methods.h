#ifndef OBSCURA_APPS_OBSCURA_METHODS_H_
#define OBSCURA_APPS_OBSCURA_METHODS_H_

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "CLI/CLI.hpp"
#include "nlohmann/json.hpp"
#include "obscura/estimator.h"

namespace obscura::app {

// Every method that --method can name, with its settings at their defaults.
struct MethodEntry {
  const char* name;
  const char* summary;
  MethodSettings defaults;
};
const std::vector<MethodEntry>& methods();
std::string method_names();
const MethodEntry* find_method(const std::string& name);

// The options of all methods, made from their tables of settings. An option that the chosen method
// does not have is refused.
class MethodOptions {
 public:
  // Adds --method and one option per field to a command.
  void add_to(CLI::App* command, const std::string& default_method);

  const std::string& method() const { return method_; }

  // The chosen method's settings with the options that were given.
  Status settings(MethodSettings* settings) const;

 private:
  struct Option {
    CLI::Option* option = nullptr;
    std::string text;
    std::vector<std::string> methods;
  };
  std::string method_;
  std::map<std::string, Option> options_;  // by C++ field name
};

// Settings as JSON, field by field.
nlohmann::ordered_json to_json(const MethodSettings& settings);

// docs/settings.md.
std::string settings_markdown();

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_METHODS_H_

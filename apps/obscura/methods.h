#ifndef OBSCURA_APPS_OBSCURA_METHODS_H_
#define OBSCURA_APPS_OBSCURA_METHODS_H_

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "apps/obscura/input.h"
#include "apps/obscura/option_table.h"
#include "io/report/json.h"
#include "obscura/estimator.h"
#include "scene/truth/geometric.h"

namespace obscura::tools {
class HeadlessVulkan;
}  // namespace obscura::tools

namespace obscura::app {

inline constexpr const char* kDefaultMethod = "far-field";

// The methods of obscura/methods.h and the truth on the real geometry, which needs a scene or mesh.
using AnySettings = std::variant<MethodSettings, tools::GeometricSettings>;

// Every method that --method can name: what MethodInfo says, with its settings at their defaults.
struct MethodEntry {
  const char* name;
  const char* summary;
  const char* page;
  bool on_vulkan;
  AnySettings defaults;
};
const std::vector<MethodEntry>& methods();
std::string method_names();

// Settings of a method in the list at their defaults, and a way to set their falloff's length.
AnySettings default_settings(const std::string& method);
void set_radius(float radius, AnySettings* settings);

// The options of all methods.
class MethodOptions {
 public:
  // Adds --method and one option per field to a command.
  void add_to(CLI::App* command, const std::string& default_method);

  const std::string& method() const { return method_; }

  // The chosen method's settings with the options that were given.
  Status settings(AnySettings* settings) const;

 private:
  std::string method_;
  OptionTable table_;
};

// What to write of the occluder into a result: the setting, and what `auto` found; "" where a
// method has none.
std::string occluder_text(const AnySettings& settings, const DepthField& field);

// What the method reads beside depth and normals.
LayerNeeds layer_needs(const AnySettings& settings);

// What is made for the first frame of a sequence and serves those of equal size after it.
struct MadeOnce {
  Estimator estimator;
  int width = 0, height = 0;  // of the estimator; 0: not made yet
  std::shared_ptr<tools::HeadlessVulkan> vulkan;
};

// Runs any method on a loaded input. `once` is for the same settings in every call.
Status run_method(const AnySettings& settings, const LoadedInput& input, const Outputs& outputs,
                  const RunOptions& options, MadeOnce* once);

// Settings as JSON, field by field.
tools::Json to_json(const AnySettings& settings);

// docs/settings.md.
std::string settings_markdown();

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_METHODS_H_

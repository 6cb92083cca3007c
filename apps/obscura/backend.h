#ifndef OBSCURA_APPS_OBSCURA_BACKEND_H_
#define OBSCURA_APPS_OBSCURA_BACKEND_H_

#include <string>

#include "apps/obscura/input.h"
#include "apps/obscura/methods.h"
#include "obscura/lighting.h"

namespace obscura::app {

// Where an estimator runs: on the CPU, or on a Vulkan device.
class BackendOptions {
 public:
  // Adds --backend and --device.
  void add_to(CLI::App* command);

  // As run_method(); `ran_on` becomes "cpu" or the device's name.
  Status run(const AnySettings& settings, const LoadedInput& input, const Outputs& outputs,
             const RunOptions& options, MadeOnce* once, std::string* ran_on) const;

  // As light(), where run() ran last, as `ran_on` says.
  Status light(const LightingInputs& inputs, const PreconvolvedEnvironment& environment,
               const LightingSettings& settings, const VectorView<float>& out,
               const RunOptions& options, const MadeOnce& once, const std::string& ran_on) const;

  // Whether a Vulkan device is asked for.
  bool vulkan() const { return backend_ != "cpu"; }

 private:
  std::string backend_ = "cpu";
  int device_ = -1;
};

// One line per Vulkan device of this machine.
Status print_devices();

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_BACKEND_H_

#include "apps/obscura/backend.h"

#include "apps/obscura/choices.h"
#include "fmt/format.h"
#ifdef OBSCURA_WITH_VULKAN
#include "device/headless.h"
#endif

namespace obscura::app {
namespace {

#ifdef OBSCURA_WITH_VULKAN

Status run_on_vulkan(int device, bool hardware_only, const AnySettings& settings,
                     const LoadedInput& input, const Outputs& outputs, const RunOptions& options,
                     MadeOnce* once, std::string* ran_on) {
  const auto* method = std::get_if<MethodSettings>(&settings);
  if (!method) return unsupported("the method geometric does not run on Vulkan");
  if (!once->vulkan) {
    auto made = std::make_shared<tools::HeadlessVulkan>();
    if (Status s = tools::HeadlessVulkan::create({.device = device}, made.get()); !s.ok()) return s;
    once->vulkan = std::move(made);
  }
  tools::HeadlessVulkan& vulkan = *once->vulkan;
  if (hardware_only && vulkan.info().software) return unsupported("there is no Vulkan hardware");
  tools::HeadlessTimes times;
  if (Status s = vulkan.run(input.field(), *method, outputs, &times); !s.ok()) return s;
  if (options.pass_times) {
    for (const auto& pass : times.passes) options.pass_times->push_back({pass.name, pass.ms});
  }
  *ran_on = vulkan.info().name;
  return {};
}

#else

Status run_on_vulkan(int, bool, const AnySettings&, const LoadedInput&, const Outputs&,
                     const RunOptions&, MadeOnce*, std::string*) {
  return unsupported("this build has no Vulkan (OBSCURA_WITH_VULKAN)");
}

#endif

}  // namespace

void BackendOptions::add_to(CLI::App* command) {
  CLI::Option* backend =
      command
          ->add_option(
              "--backend", backend_,
              "cpu, vulkan, or auto: a Vulkan device that is not software where the method and its "
              "settings run on it [default cpu]")
          ->type_name("NAME");
  set_choices(backend, "cpu, vulkan, auto");
  command
      ->add_option(
          "--device", device_,
          "Vulkan device by its number in `obscura info --devices` [default the first that "
          "is not software, or the first]")
      ->check(CLI::Range(0, 65535))
      ->type_name("N");
}

Status BackendOptions::run(const AnySettings& settings, const LoadedInput& input,
                           const Outputs& outputs, const RunOptions& options, MadeOnce* once,
                           std::string* ran_on) const {
  if (backend_ != "cpu" && backend_ != "vulkan" && backend_ != "auto") {
    return invalid_argument(
        fmt::format("--backend is '{}'; it must be one of cpu, vulkan, auto", backend_));
  }
  if (backend_ == "cpu" && device_ >= 0) {
    return invalid_argument("--device belongs to --backend vulkan or auto");
  }
  *ran_on = "cpu";
  if (backend_ != "cpu") {
    const bool automatic = backend_ == "auto";
    const Status s =
        run_on_vulkan(device_, automatic, settings, input, outputs, options, once, ran_on);
    if (s.ok() || !automatic || s.code() != StatusCode::kUnsupported) return s;
  }
  return run_method(settings, input, outputs, options, once);
}

Status BackendOptions::light(const LightingInputs& inputs,
                             const PreconvolvedEnvironment& environment,
                             const LightingSettings& settings, const VectorView<float>& out,
                             const RunOptions& options, const MadeOnce& once,
                             const std::string& ran_on) const {
#ifdef OBSCURA_WITH_VULKAN
  if (ran_on != "cpu") return once.vulkan->light(inputs, environment, settings, out);
#endif
  return obscura::light(inputs, environment, settings, out, options);
}

Status print_devices() {
#ifdef OBSCURA_WITH_VULKAN
  std::vector<tools::VulkanDeviceInfo> devices;
  if (Status s = tools::list_vulkan_devices(&devices); !s.ok()) return s;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    fmt::print("{}  {}  ({}{})\n", i, devices[i].name, devices[i].driver,
               devices[i].software ? ", software" : "");
  }
  return {};
#else
  return unsupported("this build has no Vulkan (OBSCURA_WITH_VULKAN)");
#endif
}

}  // namespace obscura::app

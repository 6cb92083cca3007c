#include "reproduce/vulkan_times.h"

#include <optional>

#include "device/headless.h"
#include "fmt/format.h"
#include "scene/scenes/load_scene.h"

namespace obscura::tools {
namespace {

// A row of a paper's table: its time in milliseconds and the GPU that took it.
struct Row {
  std::string name;
  MethodSettings settings;
  bool directions = false;
  std::optional<double> paper_ms{};
  const char* paper_gpu = "";
};
struct Table {
  const char* scene;
  ImageSize size;
  float radius_of_scene;
  std::vector<Row> rows;
};

constexpr const char* kRadeon = "Radeon 7970";
constexpr const char* kGeForce = "GeForce GTX 560 Ti";
constexpr const char* kQuadro = "Quadro FX 4800";

FarFieldSettings far_field(int directions, bool near_field, int separable) {
  FarFieldSettings s{.occluder = Occluder::solid()};
  s.directions = directions;
  s.near_field = near_field;
  s.separable = separable;
  return s;
}

std::vector<Row> far_field_rows(bool large) {
  FarFieldSettings fast{.occluder = Occluder::solid()};
  fast.preset = FarFieldPreset::kFast;
  FarFieldSettings balanced{.occluder = Occluder::solid()};
  balanced.preset = FarFieldPreset::kBalanced;
  MipmapSettings mipmap;
  std::vector<Row> rows = {
      {"far field alone, K = 8x2", far_field(8, false, 1), false, large ? 16.7 : 7.26, kRadeon},
      {"far field alone, K = 16x2", far_field(16, false, 1), false, large ? 31.6 : 13.3, kRadeon},
      {"far field alone, K = 18x2, separable", far_field(18, false, 3), false, large ? 10.0 : 4.62,
       kRadeon},
      {"fast", fast},
      {"balanced", balanced},
      {"balanced, with directions", balanced, true},
      {"default, any matter", FarFieldSettings{}},
      {"mipmap, K = 16", mipmap, false, large ? 31.5 : 19.2, kRadeon}};
  for (const auto& [interval, ms] : {std::pair{20, 6.06}, {5, 8.89}}) {
    FarFieldSettings s = far_field(8, false, 1);
    s.interval = interval;
    const std::string name = fmt::format("far field alone, K = 8x2, B0 = {}", interval);
    if (!large) rows.push_back({name, s, false, ms, kRadeon});
  }
  if (large) {
    HorizonSettings horizon;
    rows.push_back({"horizon, default, any matter", horizon});
    horizon.occluder = Occluder::solid();
    rows.push_back({"horizon, solid", horizon});
    horizon.steps = 8;
    horizon.resolution = Resolution::kHalf;
    rows.push_back({"horizon, 4 x 8, half resolution, solid", horizon});
    horizon.occluder = Occluder::automatic();
    rows.push_back({"horizon, 4 x 8, half resolution, any matter", horizon});
  }
  return rows;
}

template <class Settings>
Settings samples(int count, bool blur) {
  Settings s;
  s.samples = count;
  s.blur = blur;
  return s;
}

std::vector<Row> volumetric_rows() {
  HorizonSettings horizon{.occluder = Occluder::solid()};
  horizon.variant = HorizonVariant::kClassic;
  HemisphereSettings hemisphere{.occluder = Occluder::solid()};
  hemisphere.samples = 16;
  horizon.directions = horizon.steps = 8;
  HorizonSettings slices = horizon;
  slices.variant = HorizonVariant::kSlices;
  HorizonSettings half = slices;
  half.resolution = Resolution::kHalf;
  PointSettings screen = samples<PointSettings>(16, true);
  screen.pattern = PointPattern::kScreen;
  return {{"5 lines", samples<LineSettings>(5, false), false, 0.71, kQuadro},
          {"9 lines", samples<LineSettings>(9, false), false, 1.03, kQuadro},
          {"9 lines, blurred", samples<LineSettings>(9, true), false, 1.03 + 2.23, kQuadro},
          {"12 points", samples<PointSettings>(12, false), false, 1.31, kQuadro},
          {"33 points", samples<PointSettings>(33, false), false, 3.55, kQuadro},
          {"1 area", samples<AreaSettings>(1, false)},
          {"9 areas", samples<AreaSettings>(9, false)},
          {"horizon, classic, 8 x 8", horizon, false, 60.55, kQuadro},
          {"horizon, classic, 8 x 8, with directions", horizon, true},
          {"horizon, slices, 8 x 8", slices},
          {"horizon, slices, 8 x 8, half resolution", half},
          {"Crytek2D, 16 samples", screen},
          {"Crytek2D, 16 samples, with directions", screen, true},
          {"Crytek3D, 16 samples, 3 steps", hemisphere},
          {"Crytek3D, 16 samples, 3 steps, with directions", hemisphere, true}};
}

std::vector<Table> tables() {
  return {{"meadow", {1280, 720}, 0.04f, far_field_rows(false)},
          {"meadow", {1920, 1080}, 0.04f, far_field_rows(true)},
          {"cornell", {1024, 1024}, 0.05f, volumetric_rows()},
          {"hall",
           {2048, 1024},
           0.05f,
           {{"Crytek3D, 8 samples, 3 steps, with directions",
             HemisphereSettings{.occluder = Occluder::solid()}, true, 4.2 + 4.7, kGeForce}}}};
}

struct Device {
  HeadlessVulkan vulkan;
  double bandwidth = 0;  // bytes per second
  int runs = 1;
};

Status time_row(Device& device, const DepthInput& input, const Row& row, const std::string& name,
                Report* report, std::string* text) {
  const DepthField field = input.field();
  const int width = field.visible().width, height = field.visible().height;
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  std::vector<float> values(pixels * (row.directions ? 5 : 1));
  auto view = [&](int i) { return ImageView<float>{values.data() + pixels * i, width, height}; };
  Outputs outputs{.visibility = view(0)};
  if (row.directions) {
    outputs.bent_normal = {view(1), view(2), view(3)};
    outputs.cone_angle = view(4);
  }
  HeadlessTimes times;
  const Status s = device.vulkan.run(field, row.settings, outputs, &times, {}, device.runs);
  if (s.code() == StatusCode::kUnsupported) {
    *text += fmt::format("- {}: {}\n", name, s.message());
    return {};
  }
  if (!s.ok()) return s;
  auto add = [&](const std::string& what, double ms, double bytes) {
    report->add(what, "device", ms, "ms");
    report->add(what, "memory touched", bytes * 1e-6, "MB");
    report->add(what, "of the copy bandwidth", 1e5 * bytes / ms / device.bandwidth, "%");
  };
  double bytes = 0;
  for (const HeadlessPass& pass : times.passes) bytes += pass.bytes;
  add(name, times.total_ms(), bytes);
  report->add(name, "record()", times.record_us, "us", 50);
  if (row.paper_ms) report->add(name, fmt::format("paper, {}", row.paper_gpu), *row.paper_ms, "ms");
  for (const HeadlessPass& pass : times.passes) {
    add(fmt::format("{}: {}", name, pass.name), pass.ms, pass.bytes);
  }
  return {};
}

}  // namespace

Status reproduce_vulkan_times(const ReproduceContext& context, Report* report, std::string* text) {
  Device device;
  if (Status s = HeadlessVulkan::create({}, &device.vulkan); !s.ok()) return s;
  if (Status s = device.vulkan.copy_bandwidth(&device.bandwidth); !s.ok()) return s;
  const VulkanDeviceInfo& info = device.vulkan.info();
  device.runs = info.software ? 2 : 20;
  *text += fmt::format(
      "On {} ({}{}), which copies {:.1f} GB/s. The first line of each row is the whole, conversion "
      "and normals included; the fastest of {} runs of each pass counts. A pass's memory is "
      "counted "
      "once, whatever it reads twice. The papers' times are of their own GPUs, without conversion "
      "and normals.\n\n",
      info.name, info.driver, info.software ? ", software" : "", device.bandwidth * 1e-9,
      device.runs);
  const auto executor = make_executor(context.threads);
  const std::vector<Table> all = tables();
  for (std::size_t t = 0; t < all.size(); ++t) {
    const Table& table = all[t];
    Rendering rendering;
    ViewOptions options;
    options.size = table.size;
    if (Status s = load_scene(fmt::format("scene:{}", table.scene), options, *executor, &rendering);
        !s.ok()) {
      return s;
    }
    const float radius = table.radius_of_scene * static_cast<float>(rendering.gbuffer.scene_size);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      Row row = table.rows[i];
      std::visit([&](auto& s) { s.falloff.radius = radius; }, row.settings);
      const std::string name =
          fmt::format("{}x{}, {}", table.size.width, table.size.height, row.name);
      if (!context.step(name, (t + double(i) / table.rows.size()) / all.size())) {
        return {StatusCode::kCancelled, "stopped by the caller"};
      }
      if (Status s = time_row(device, rendering.gbuffer, row, name, report, text); !s.ok()) {
        return s;
      }
    }
  }
  return {};
}

}  // namespace obscura::tools

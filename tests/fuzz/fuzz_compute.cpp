#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "obscura/obscura.h"
#include "tests/fuzz/bytes.h"

using namespace obscura;

namespace {

constexpr const char* kTexts[] = {
    "0",        "1",  "2",    "3",      "0.5",  "1e-30", "1e30", "inf",        "-1",
    "1,2",      "16", "true", "false",  "auto", "solid", "half", "back-depth", "thickness:0.3",
    "adaptive", "9",  "64",   "power:2"};

// Where a number is what a call takes time for, not what it does; `every` leaves pixels NaN.
bool left_alone(std::string_view field) {
  return field == "every" || field == "rays" || field == "samples" || field == "directions" ||
         field == "steps";
}

}  // namespace

// Any depth field, camera and settings: refused, or visibility in [0, 1], and the same on one
// thread and two.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const auto names = method_names();
  MethodSettings settings;
  const std::string_view method = names[static_cast<std::size_t>(bytes.below(int(names.size())))];
  if (!make_settings(method, &settings).ok()) std::abort();
  if (method == "ray-traced" && !set(&settings, "rays", "4").ok()) std::abort();
  std::vector<std::string> fields;
  for_each_field(settings, [&](auto&, const Field& f) { fields.emplace_back(f.name); });
  for (int i = bytes.below(5); i > 0; --i) {
    const std::string& field = fields[static_cast<std::size_t>(bytes.below(int(fields.size())))];
    const std::string text = kTexts[bytes.below(int(std::size(kTexts)))];
    if (!left_alone(field)) (void)set(&settings, field, text);
  }
  const int w = 1 + bytes.below(24), h = 1 + bytes.below(24);
  DepthField in;
  in.depth_kind = static_cast<DepthKind>(bytes.below(kEnumCount<DepthKind>));
  in.camera = {};
  in.camera.orthographic = bytes.flag();
  in.camera.scale_x = bytes.flag() ? bytes.number() : 0.05f;
  in.camera.scale_y = bytes.flag() ? bytes.number() : 0.05f;
  in.camera.center_u = bytes.flag() ? bytes.number() : float(w) / 2;
  in.camera.center_v = bytes.flag() ? bytes.number() : float(h) / 2;
  in.near_plane = bytes.flag() ? bytes.number() : 0.1f;
  if (bytes.flag()) in.far_plane = bytes.number();
  if (bytes.flag()) in.guard_band = GuardBand::symmetric(bytes.below(4), bytes.below(4));
  const auto pixels = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
  std::vector<float> depth(pixels), normals, back;
  for (float& v : depth) v = bytes.depth();
  in.depth = {depth.data(), w, h};
  if (bytes.flag()) {
    normals.resize(3 * pixels);
    for (float& v : normals) v = bytes.depth() - 2;
    in.normals = VectorView<const float>::interleaved(normals.data(), w, h);
  }
  if (bytes.flag()) {
    back.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) back[i] = depth[i] + bytes.depth();
    in.back_depth = {back.data(), w, h};
  }
  const Extent visible = in.visible();
  if (visible.width < 1 || visible.height < 1) return 0;
  std::vector<float> first(pixels, -3), second(pixels, -3);
  auto run = [&](std::vector<float>* out, int threads) {
    RunOptions options;
    options.threads = threads;
    return compute(in, settings, {.visibility = {out->data(), visible.width, visible.height}},
                   options);
  };
  const Status status = run(&first, 1);
  const auto count = static_cast<std::size_t>(visible.width) * std::size_t(visible.height);
  for (std::size_t i = 0; i < count; ++i) {
    const float v = first[i];
    if (!status.ok() && v != -3) std::abort();
    if (status.ok() && !(v >= 0 && v <= 1)) std::abort();
  }
  if (!status.ok()) {
    if (status.message().empty()) std::abort();
    return 0;
  }
  if (!run(&second, 2).ok() || first != second) std::abort();
  return 0;
}

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "scene/scenes/scene.h"
#include "scene/views/view_options.h"

using namespace obscura;

// Text behind "scene:" up to what would be rendered: refused in words, or a view that is valid.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::string name;
  tools::SceneParameters parameters;
  if (!tools::split_scene("scene:" + text, &name, &parameters).ok()) return 0;
  tools::ViewOptions options;
  if (!tools::read_fields(parameters, &options).ok()) return 0;
  tools::ViewSpec view;
  const Status s = tools::apply_options(options, &view);
  if (!s.ok()) {
    if (s.message().empty()) std::abort();
    return 0;
  }
  if (!tools::validate(view).ok()) std::abort();
  return 0;
}

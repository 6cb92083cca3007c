#include <cstdint>
#include <cstdlib>

#include "io/images/depth_file.h"
#include "io/images/describe.h"
#include "tests/fuzz/memory_file.h"

using namespace obscura;

// What is loaded has the size that it says.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const fuzz::MemoryFile file(data, size, ".exr");
  tools::DepthFileOptions options;
  options.fov_y = 60;
  options.normal_space = size % 2 ? tools::NormalSpace::kWorld : tools::NormalSpace::kView;
  options.layers = 2;
  tools::DepthInput input;
  for (int pass = 0; pass < 2; ++pass) {
    if (tools::load_depth_input(file.path(), options, &input).ok()) {
      const std::size_t pixels = static_cast<std::size_t>(input.width) * input.height;
      if (input.depth.size() != pixels || input.field().visible().width < 1) std::abort();
      for (const auto* v : {&input.normal_x, &input.normal_y, &input.normal_z, &input.back_depth}) {
        if (!v->empty() && v->size() != pixels) std::abort();
      }
    }
    options.fov_y = {};  // now from the file's matrices
  }
  tools::Json description;
  if (tools::describe_image(file.path(), &description).ok()) {
    tools::description_text(description);
  }
  return 0;
}

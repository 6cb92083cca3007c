#include "bench/bench_input.h"

#include "fmt/format.h"
#include "scene/scenes/load_scene.h"

namespace obscura::bench {

tools::DepthInput bench_input(int width, int height) {
  tools::DepthInput input;
  const Status status =
      tools::load_scene(fmt::format("scene:hall?size={}x{}&guard-band=0", width, height), &input);
  if (!status.ok()) fmt::print(stderr, "{}\n", status.message());
  return input;
}

}  // namespace obscura::bench

#!/usr/bin/env bash
# Shows that check_layers.sh fails on a tree that breaks a rule, for each of its rules, in C++ and in
# shaders.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/src/screen/{far_field,volumetric/{line,point},half_resolution}
broken=0

# good FILE LINE: the rules hold where FILE has the line.
good() {
  mkdir -p "$tree/$(dirname "$1")"
  printf '%s\n' "$2" >"$tree/$1"
  if ! "$here/check_layers.sh" "$tree" >/dev/null 2>"$tree/errors"; then
    echo "check_layers_test: refused although allowed: $1: $2" >&2
    cat "$tree/errors" >&2
    exit 1
  fi
  rm "$tree/$1"
}
# bad FILE LINE RULE: that rule is broken where FILE has the line.
bad() {
  mkdir -p "$tree/$(dirname "$1")"
  printf '%s\n' "$2" >"$tree/$1"
  if "$here/check_layers.sh" "$tree" >/dev/null 2>"$tree/errors" ||
     ! grep -q "^layering: .*$3" "$tree/errors"; then
    echo "check_layers_test: passed although '$3' is broken: $1: $2" >&2
    exit 1
  fi
  rm "$tree/$1"
  broken=$((broken + 1))
}

good src/screen/volumetric/line/cpu.cpp '#include "screen/volumetric/point/plan.h"'
good src/screen/far_field/scan.comp '#include "gpu/view.glsl"'
good src/screen/far_field/plan.h '#include "screen/method.h"'
good src/screen/far_field/gpu.cpp '#include "obscura/vulkan.h"'
good src/screen/far_field/gpu.cpp '// The caller calls vkQueueSubmit.'
good src/math/slab_leaf.h '#include "math/azimuth_leaf.h"'
good src/vulkan/recorder.cpp '#include <vulkan/vulkan_core.h>'
good include/obscura/vulkan.h '#include <vulkan/vulkan_core.h>'
good scene/views/view.h '#include "io/images/image.h"'
good examples/vulkan.cpp '#include <volk.h>'
good bench/bench.cpp '#include "screen/far_field/plan.h"'

bad src/math/a.h '#include "../core/b.h"' 'paths begin at a room'
bad include/obscura/a.h '#include "core/text.h"' 'public headers'
bad include/obscura/vulkan.h '#include "vulkan/functions.h"' 'public headers'
bad src/view/camera.cpp '#include "io/images/image.h"' 'neither files nor the command'
bad src/screen/far_field/cpu.cpp '#include <CLI/CLI.hpp>' 'neither files nor the command'
bad src/volume/distance.cpp '#include <thread>' 'only core starts threads'
bad src/core/a.cpp '#include "view/geometry.h"' 'core stands alone'
bad src/math/a.glsl '#include "view/taps.glsl"' 'math knows'
bad src/math/a_leaf.h '#include <cmath>' 'leaf files'
bad src/filters/edge_leaf.h '#include "math/falloff.h"' 'leaf files'
bad src/gpu/results.glsl '#include "filters/edge_leaf.h"' 'gpu knows'
bad src/gpu/program.cpp '#include "screen/method.h"' 'gpu knows'
bad src/view/depth.comp '#include "screen/far_field/far_field.glsl"' 'view knows'
bad src/filters/bilateral/bilateral.comp '#include "screen/far_field/far_field.glsl"' 'filters know'
bad src/screen/far_field/cpu.cpp '#include "lighting/cube_grid.h"' 'estimators know'
bad src/screen/far_field/cpu.cpp '#include "screen/volumetric/dual.h"' 'another estimator'
bad src/screen/far_field/scan.comp '#include "screen/volumetric/area/moments.glsl"' 'another estimator'
bad src/screen/far_field/sums_leaf.h '#include "screen/volumetric/line/line_leaf.h"' 'another estimator'
bad src/screen/half_resolution/cpu.cpp '#include "screen/far_field/plan.h"' 'another estimator'
bad src/screen/far_field/table.inc '#include "screen/volumetric/line/plan.h"' 'another estimator'
bad src/lighting/light.cpp '#include "screen/method.h"' 'lighting knows'
bad src/volume/light.cpp '#include "view/geometry.h"' 'volume knows'
bad src/terrain/plane.h '#include "volume/transport.h"' 'terrain knows'
bad src/vulkan/recorder.cpp '#include "volume/transport.h"' 'the recorder knows'
bad src/gpu/program.h '#include <vulkan/vulkan_core.h>' 'include Vulkan'
bad src/screen/far_field/gpu.cpp '#include "vulkan/functions.h"' 'include Vulkan'
bad apps/viewer/main.cpp '#include <volk.h>' 'include Vulkan'
bad src/gpu/program.cpp '  vkCmdDispatch(commands, 1, 1, 1);' 'call Vulkan'
bad reproduce/times.cpp '  flags |= VK_QUEUE_COMPUTE_BIT;' 'call Vulkan'
bad src/screen/far_field/plan.h '#include "obscura/vulkan.h"' 'files of the CPU'
bad io/images/image.h '#include "core/text.h"' "io uses the library's public headers"
bad scene/rays/rays.h '#include "view/geometry.h"' "scene uses the library's public headers"
bad device/headless.cpp '#include "vulkan/functions.h"' "device uses the library's public headers"
bad reproduce/table.cpp '#include "screen/far_field/plan.h"' "reproduce uses the library's public headers"
bad apps/obscura/main.cpp '#include "core/text.h"' "apps uses the library's public headers"
bad examples/a.cpp '#include "shaders/line.h"' "examples uses the library's public headers"
bad io/images/image.h '#include "scene/views/view_spec.h"' 'io stands'
bad scene/views/view.h '#include "device/headless.h"' 'scene knows'
bad device/headless.h '#include "io/images/image.h"' 'device stands'
bad reproduce/table.cpp '#include "apps/obscura/app.h"' 'reproduce knows'
bad bench/bench.cpp '#include "apps/obscura/app.h"' 'benchmarks do not know'
bad apps/obscura/main.cpp '#include "reproduce/reproduce.h"' 'apps and examples know'
echo "layering: each rule found when broken, $broken times"

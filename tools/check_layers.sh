#!/usr/bin/env bash
# Checks who may include whom, in C++ and in shaders. usage: tools/check_layers.sh [FOLDER]
# The rules are those of CONTRIBUTING.md; tools/check_layers_test.sh breaks each of them once.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"
failures=0
files=$({
  find include src io scene device reproduce bench apps examples \
    \( -name '*.h' -o -name '*.cpp' -o -name '*.inc' -o -name '*.comp' -o -name '*.glsl' \) \
    2>/dev/null || true
} | sort)

report() {
  if [ -n "$2" ]; then
    printf 'layering: %s\n%s\n' "$1" "$2" >&2
    failures=$((failures + 1))
  fi
}

# rule NAME FILES FORBIDDEN: no file that matches FILES includes a path that begins with FORBIDDEN.
rule() {
  report "$1" "$(grep -E "$2" <<<"$files" |
    xargs -r grep -nHE "^[[:space:]]*#[[:space:]]*include[[:space:]]+[<\"]($3)" || true)"
}
# rule_of_names NAME FILES FORBIDDEN: no line of code in these files has a match of FORBIDDEN.
# Comments at the end of a line and on lines of their own do not count.
rule_of_names() {
  report "$1" "$(grep -E "$2" <<<"$files" |
    xargs -r awk -v forbidden="$3" '{ code = $0; sub(/\/\/.*/, "", code) }
      code ~ forbidden { print FILENAME ":" FNR ":" $0 }' || true)"
}

# Vulkan's own headers, vulkan/vulkan*.h, lie in a folder of the same name as the room.
recorder='vulkan/([^v]|v[^u])'
rooms="core/|math/|gpu/|view/|filters/|screen/|lighting/|volume/|terrain/|$recorder|shaders/"
files_and_command='io/|scene/|device/|reproduce/|bench/|apps/|examples/|tests/'

rule 'paths begin at a room' '.' '\.\.?/'
rule 'public headers include public headers only' '^include/' \
  "$rooms|$files_and_command|hwy/|tbb/"
rule 'the library knows neither files nor the command' '^src/' \
  "$files_and_command|CLI|fmt/|nlohmann|Imf|Open|stb"
rule 'only core starts threads' '^src/(math|gpu|view|filters|screen|lighting|volume|terrain|vulkan)/' \
  'thread>|mutex>|condition_variable>|future>|tbb/'

# Inside the library, from the ground up.
rule 'core stands alone' '^src/core/' "math/|gpu/|view/|filters/|screen/|lighting/|volume/|terrain/|$recorder"
rule 'math knows core only' '^src/math/' "gpu/|view/|filters/|screen/|lighting/|volume/|terrain/|$recorder"
report 'leaf files include leaf files only' "$(grep -E '_leaf\.h$' <<<"$files" |
  xargs -r grep -nHE '^[[:space:]]*#[[:space:]]*include' | grep -v '_leaf\.h"' || true)"
rule 'gpu knows core and math only' '^src/gpu/' "view/|filters/|screen/|lighting/|volume/|terrain/|$recorder"
rule 'view knows core, math and gpu only' '^src/view/' "filters/|screen/|lighting/|volume/|terrain/|$recorder"
rule 'filters know core, math, gpu and view only' '^src/filters/' "screen/|lighting/|volume/|terrain/|$recorder"
rule 'estimators know core, math, gpu, view and filters only' '^src/screen/' "lighting/|volume/|terrain/|$recorder"
rule 'lighting knows core, math, gpu, view and filters only' '^src/lighting/' "screen/|volume/|terrain/|$recorder"
rule 'volume knows core and math only' '^src/volume/' \
  "gpu/|view/|filters/|screen/|lighting/|terrain/|$recorder"
rule 'terrain knows core and math only' '^src/terrain/' \
  "gpu/|view/|filters/|screen/|lighting/|volume/|$recorder"
rule 'the recorder knows of lighting its passes, and neither volumes nor terrain' '^src/vulkan/' \
  'lighting/([^g]|g[^p])|volume/|terrain/'

# An estimator is a folder of src/screen; files beside the folders are what all of them share.
for folder in src/screen/*/; do
  [ -d "$folder" ] || continue
  name=$(basename "$folder")
  others=$(find src/screen -mindepth 1 -maxdepth 1 -type d -not -name "$name" -printf '%f\n' | paste -sd '|')
  [ -n "$others" ] && rule "src/screen/$name includes another estimator" "^src/screen/$name/" "screen/($others)/"
done

# Vulkan's headers and calls: the recorder and the device. Examples show both to the user.
no_vulkan='^(src/(core|math|gpu|view|filters|screen|lighting|volume|terrain)|io|scene|reproduce|bench|apps)/'
rule 'only src/vulkan and device include Vulkan' "$no_vulkan" 'vulkan/|volk'
rule_of_names 'only src/vulkan and device call Vulkan' "$no_vulkan" '(^|[^A-Za-z0-9_])(vk[A-Z]|VK_)'
rule 'files of the CPU do not include obscura/vulkan.h' \
  '^src/((core|math|view|lighting|volume|terrain)/|.*/(plan|cpu|kernel)[^/]*$)' 'obscura/vulkan'

# Outside the library: public headers, and of each other's rooms those before it.
for room in io scene device reproduce apps examples; do
  rule "$room uses the library's public headers only" "^$room/" "$rooms"
done
rule 'io stands on the library alone' '^io/' 'scene/|device/|reproduce/|bench/|apps/'
rule 'scene knows io only' '^scene/' 'device/|reproduce/|bench/|apps/'
rule 'device stands on the library alone' '^device/' 'io/|scene/|reproduce/|bench/|apps/'
rule 'reproduce knows io, scene and device only' '^reproduce/' 'bench/|apps/'
rule 'benchmarks do not know the command' '^bench/' 'apps/'
rule 'apps and examples know io, scene and device only' '^(apps|examples)/' 'reproduce/|bench/'

if [ "$failures" -gt 0 ]; then
  exit 1
fi
echo "layering: rules hold"

#!/usr/bin/env bash
# Checks the layering rules: who may include whom. usage: tools/check_layers.sh [FOLDER]
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"
failures=0

# rule NAME FILES_REGEX FORBIDDEN_INCLUDE_REGEX: no matching file includes a matching path.
rule() {
  local name=$1 files=$2 forbidden=$3 hits
  hits=$(find include src support apps examples \( -name '*.h' -o -name '*.cpp' \) 2>/dev/null |
    grep -E "$files" | sort |
    xargs -r grep -nHE "^[[:space:]]*#[[:space:]]*include[[:space:]]+[<\"]($forbidden)" || true)
  if [ -n "$hits" ]; then
    printf 'layering: %s\n%s\n' "$name" "$hits" >&2
    failures=$((failures + 1))
  fi
}

rooms='core|math|view|screen|directional|filters|lighting|volume|vulkan'
# Vulkan's own headers lie in a folder of the same name as the room.
rule 'public headers include public headers only' '^include/' \
  "(${rooms%|vulkan}|support|apps|hwy|tbb)/|vulkan/(program|functions|frame_constants)"
rule 'only the Vulkan room knows Vulkan' '^(src/(core|math|view|screen|directional|filters|lighting|volume)|apps)/' \
  '(vulkan/|volk|obscura/vulkan)'
rule 'the library knows neither files nor the command' '^src/' '(support|apps|CLI|fmt|nlohmann|Imf|Open)'
rule 'only core starts threads' '^src/(math|view|screen|directional|filters|lighting|volume)/' '(thread>|mutex>|tbb/|future>)'
rule 'core stands alone' '^src/core/' "(math|view|screen|directional|filters|lighting|volume|vulkan)/"
rule 'math knows core only' '^src/math/' "(view|screen|directional|filters|lighting|volume|vulkan)/"
rule 'view knows core and math only' '^src/view/' "(screen|directional|filters|lighting|volume|vulkan)/"
rule 'filters know core, math and view only' '^src/filters/' "(screen|directional|lighting|volume|vulkan)/"
rule 'support uses public headers only' '^support/' "($rooms)/"
rule 'apps use public headers and support only' '^(apps|examples)/' "($rooms)/"

# Estimators never include each other.
for folder in src/screen/*/; do
  [ -d "$folder" ] || continue
  name=$(basename "$folder")
  others=$(find src/screen -mindepth 1 -maxdepth 1 -type d -not -name "$name" -printf '%f\n' | paste -sd '|')
  [ -n "$others" ] && rule "estimator $name includes another" "^src/screen/$name/" "screen/($others)/"
done

if [ "$failures" -gt 0 ]; then
  exit 1
fi
echo "layering: rules hold"

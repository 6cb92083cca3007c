#!/usr/bin/env bash
# An elevation model larger than the memory it is computed in: of 30,000 x 30,000 cells within 2 GB,
# made on the fly; then once more, killed twice on its way, with the same bits. Prints times and
# memory. usage: tools/terrain_large.sh BUILD_FOLDER [CELLS [MEMORY_MB]]
set -euo pipefail
build=$(realpath "$1") side=${2:-30000} memory=${3:-2000}
work=$(mktemp -d -p "${TMPDIR:-/tmp}" obscura-large-XXXXXX)
trap 'rm -rf "$work"' EXIT
# The model, bands of results, and the two outputs; all at most 4 bytes a cell.
needed=$((side * side * 16 / 1000000 + 2000))
free=$(($(df --output=avail -k "$work" | tail -n 1) / 1000))
if [ "$free" -lt "$needed" ]; then
  echo "terrain_large: skipped, $work has $free MB free and $needed are needed" >&2
  exit 0
fi
start=$SECONDS
"$build/bin/obscura_terrain_model" "$side" "$work/land.bin"
echo "model: ${side}x$side, $((SECONDS - start)) s"

# Computes svf into $1; kills the run as soon as the file $2 is there, if given.
run() {
  "$build/bin/obscura" terrain "$work/land.bin" -o "$work/$1" --memory "${memory}M" -q &
  local pid=$! peak=0 now
  while kill -0 $pid 2>/dev/null; do
    now=$(awk '/VmHWM/ { print $2 }' "/proc/$pid/status" 2>/dev/null || true)
    [ "${now:-0}" -gt "$peak" ] && peak=$now
    if [ -n "${2:-}" ] && [ -e "$work/$1.bands/$2" ]; then
      { kill -9 $pid && wait $pid; } 2>/dev/null || true
      echo "killed at $2"
      return
    fi
    sleep 0.2
  done
  wait $pid
  if [ -n "${2:-}" ]; then
    echo "terrain_large: it ended before $2" >&2
    return 1
  fi
  peak=$((peak * 1024 / 1000000))
  echo "peak memory: $peak MB of $memory"
  [ "$peak" -le "$memory" ]
}
start=$SECONDS
run once.tif
seconds=$((SECONDS - start))
echo "at once: $seconds s, $((side * side / (seconds > 0 ? seconds : 1) / 1000)) thousand cells a second"
start=$SECONDS
run killed.tif down-2.f32
run killed.tif up-3.f32
run killed.tif
echo "killed twice: $((SECONDS - start)) s"
cmp "$work/once.tif" "$work/killed.tif"
echo "the same bits"

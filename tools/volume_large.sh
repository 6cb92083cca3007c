#!/usr/bin/env bash
# A volume larger than the memory it is computed in: 2048 x 2048 x 1024 bytes (4.3 GB) within 6 GB,
# then 512^3 in memory and within 512 MB, killed on its way as well, with the same bits. Prints times
# and memory. usage: tools/volume_large.sh BUILD_FOLDER [SIDE [MEMORY_MB]]; a side gives
# SIDE x SIDE x SIDE/2 voxels
set -euo pipefail
build=$(realpath "$1") side=${2:-2048} memory=${3:-6000}
work=$(mktemp -d -p "${TMPDIR:-/tmp}" obscura-large-XXXXXX)
trap 'rm -rf "$work"' EXIT
# Bytes a voxel: the model 1, distances twice 4, half the visibilities 3, the field 0.5.
needed=$((side * side / 2 * side * 125 / 10 / 1000000 + 4000))
free=$(($(df --output=avail -k "$work" | tail -n 1) / 1000))
if [ "$free" -lt "$needed" ]; then
  echo "volume_large: skipped, $work has $free MB free and $needed are needed" >&2
  exit 0
fi

# stream SIZE MODEL OUTPUT MEMORY_MB [FILE]: the mean visibility; kills the run as soon as FILE is in
# its folder of work, if given. Leaves the seconds in `seconds`.
stream() {
  local start=$SECONDS peak=0 now pid
  "$build/bin/obscura" volume "$work/$2" --raw-size "$1" --iso 120 --fields "$work/$3" \
    --fields-of scalar --memory "$4M" -q &
  pid=$!
  while kill -0 $pid 2>/dev/null; do
    now=$(awk '/VmHWM/ { print $2 }' "/proc/$pid/status" 2>/dev/null || true)
    [ "${now:-0}" -gt "$peak" ] && peak=$now
    if [ -n "${5:-}" ] && [ -e "$work/$3.work/$5" ]; then
      { kill -9 $pid && wait $pid; } 2>/dev/null || true
      echo "killed at $5"
      return
    fi
    sleep 0.1
  done
  wait $pid
  seconds=$((SECONDS - start))
  if [ -n "${5:-}" ]; then
    echo "volume_large: it ended before $5" >&2
    return 1
  fi
  peak=$((peak * 1024 / 1000000))
  echo "$1: $seconds s, peak memory $peak MB of $4"
  [ "$peak" -le "$4" ]
}

"$build/bin/obscura_volume_model" 512 512 512 "$work/small.raw"
start=$(date +%s%N)
"$build/bin/obscura" volume "$work/small.raw" --raw-size 512x512x512 --iso 120 \
  --fields "$work/whole.nrrd" --fields-of scalar -q
echo "512x512x512 in memory: $((($(date +%s%N) - start) / 1000000)) ms"
start=$(date +%s%N)
stream 512x512x512 small.raw slabs.nrrd 512
echo "512x512x512 in slabs: $((($(date +%s%N) - start) / 1000000)) ms"
cmp "$work/whole.nrrd" "$work/slabs.nrrd"
stream 512x512x512 small.raw killed.nrrd 512 odd.f32
stream 512x512x512 small.raw killed.nrrd 512 fallen.u8
stream 512x512x512 small.raw killed.nrrd 512
cmp "$work/whole.nrrd" "$work/killed.nrrd"
echo "the same bits"
rm "$work"/*.nrrd "$work/small.raw"

"$build/bin/obscura_volume_model" "$side" "$side" $((side / 2)) "$work/large.raw"
stream "${side}x${side}x$((side / 2))" large.raw large.nrrd "$memory"

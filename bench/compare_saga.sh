#!/usr/bin/env bash
# Processor time of the sky-view factor by SAGA (Debian package saga, 8 sectors, no limit of
# distance) and by obscura terrain (16 azimuths, no limit) on one model.
# usage: bench/compare_saga.sh [SIDE [OBSCURA]]   SIDE: cells a side [1000]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
side=${1:-1000} obscura=$(realpath "${2:-build/release/bin/obscura}")
command -v saga_cmd >/dev/null || { echo "saga_cmd is missing: apt-get install saga" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Mountains: waves of all lengths, their height in proportion to their length.
awk -v n="$side" 'BEGIN {
  srand(7); waves = 40; pi = atan2(0, -1)
  for (w = 0; w < waves; ++w) {
    length_ = 4 * exp(w / waves * log(n / 4)); angle = 2 * pi * rand()
    a[w] = 2 * pi * cos(angle) / length_; b[w] = 2 * pi * sin(angle) / length_
    phase[w] = 2 * pi * rand(); height[w] = 0.9 * length_
  }
  printf "ncols %d\nnrows %d\nxllcorner 0\nyllcorner 0\ncellsize 30\nNODATA_value -99999\n", n, n
  for (y = 0; y < n; ++y) {
    line = ""
    for (x = 0; x < n; ++x) {
      z = 2000; for (w = 0; w < waves; ++w) z += height[w] * sin(a[w] * x + b[w] * y + phase[w])
      line = line sprintf("%.2f ", z)
    }
    print line
  }
}' >"$work/model.asc"

# Runs a command and leaves its processor seconds in `seconds`.
processor() {
  local TIMEFORMAT='%U %S'
  seconds=$({ time "$@" >"$work/log" 2>&1; } 2>&1 | awk '{ print $1 + $2 }')
}
saga_cmd -f=s io_gdal 0 -FILES="$work/model.asc" -GRIDS="$work/model.sgrd" >"$work/log" 2>&1
processor saga_cmd -f=s ta_lighting 3 -DEM="$work/model.sgrd" -SVF="$work/svf.sgrd" \
  -VISIBLE="$work/visible.sgrd" -METHOD=0 -NDIRS=8 -RADIUS=1e6
saga=$seconds
ours=$("$obscura" terrain "$work/model.asc" -o "$work/ours.npy" --quantity svf-normal --threads 1 -q \
  --json - | awk -F'[:,]' '/time to compute/ { found = 1 } found && /"value"/ { print $2 / 1000; exit }')
echo "SAGA, 8 sectors: $saga s; obscura, 16 azimuths: $ours s; $(awk -v a="$saga" -v b="$ours" \
  'BEGIN { printf "%.0f", a / b }') times"

#!/usr/bin/env bash
# A shot of 1920x1080 frames as a farm treats it: time, memory, kills, a full disk.
# usage: sequence_check.sh [FRAMES]   48 by default
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
obscura=$PWD/build/release/bin/obscura
frames=${1:-48}
work=$(mktemp -d)
clean_up() {
  umount "$work/small" 2>/dev/null || true
  rm -rf "$work"
}
trap clean_up EXIT
cd "$work"
fail() {
  echo "sequence_check: $*" >&2
  exit 1
}
last=$((29 + frames))
ao() { "$obscura" ao shot.####.exr --frames "30-$last" --preset fast -q "$@"; }
sums() { (cd "$1" && sha256sum ao.*.exr); }

"$obscura" gbuffer 'scene:hall?size=1920x1080&fov-y=##' --frames "30-$last" -o shot.####.exr -q
mkdir whole killed small

# Time: against the CPU time of frames alone on one thread, start of the program included.
ao -o whole/ao.####.exr --json report.json
value() {
  awk -v metric="\"metric\": \"$1\"," 'index($0, metric) { getline; sub(",", "", $2); print $2 }' report.json
}
TIMEFORMAT='%U %S'
alone=0
for frame in 30 $((29 + frames / 2)) "$last"; do
  seconds=$({ time "$obscura" ao "shot.00$frame.exr" -o one.exr --preset fast -q --threads 1; } 2>&1)
  alone=$(echo "$alone $seconds" | awk '{ print $1 + $2 + $3 }')
done
awk -v wall="$(value time)" -v alone="$alone" -v frames="$frames" -v cores="$(nproc)" \
  -v memory="$(value 'peak memory')" 'BEGIN {
    bound = alone / 3 * frames / cores
    printf "%d frames in %.1f s, %.2f times the bound of %.1f s; peak memory %.0f MB\n",
           frames, wall / 1000, wall / 1000 / bound, bound, memory
    exit !(memory > 0 && memory < 600)
  }' || fail "more than 600 MB"

# Killed at any second and run again: every frame once, whole, the same bits.
for kill in 1 2 3 5 7; do
  timeout -s KILL "$kill" "$obscura" ao shot.####.exr --frames "30-$last" --preset fast -q \
    --skip-existing -o killed/ao.####.exr || true
done
ao --skip-existing -o killed/ao.####.exr
[ "$(sums whole)" = "$(sums killed)" ] || fail "frames differ after kills"

# A disk that is full in the middle, at the thirtieth frame of 48.
whole_ones=$((frames * 5 / 8 - 1))
full_at=$(printf '%s\n' whole/ao.*.exr | head -n $((whole_ones + 1)) | xargs stat -c %s |
  awk '{ sum += $1; last = $1 } END { print int(sum - last / 2) }')
if [ "$(id -u)" -eq 0 ] && mount -t tmpfs -o "size=$full_at" tmpfs small 2>/dev/null; then
  code=0
  ao -o small/ao.####.exr 2>message || code=$?
  [ "$code" -eq 1 ] || fail "exit code $code on a full disk"
  (cd small && for f in ao.*.exr; do cmp "$f" "../whole/$f"; done)
  left=$(ls small | wc -l)
  echo "a full disk leaves $left whole frames: $(cat message)"
  [ "$left" -eq "$whole_ones" ] || fail "not $whole_ones whole frames on a full disk"
fi

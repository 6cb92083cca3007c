#!/usr/bin/env bash
# Every fuzzer of tests/fuzz for its share of HOURS, on one core: tools/fuzz.sh HOURS. A line per
# fuzzer with its executions; inputs that fail stay in build/fuzz/failures. What they find beyond
# tests/fuzz/corpus is kept in build/fuzz/samples for the next run.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
hours=${1:-1}
mapfile -t names < <(cd tests/fuzz && printf '%s\n' fuzz_*.cpp | sed 's/\.cpp$//')
seconds=$(awk -v h="$hours" -v n="${#names[@]}" 'BEGIN { s = int(h * 3600 / n); print s < 1 ? 1 : s }')
mkdir -p build/fuzz/failures
failed=0
for name in "${names[@]}"; do
  mkdir -p "build/fuzz/samples/$name"
  log=build/fuzz/samples/$name.log
  options=(-max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 -max_len=16384
    -artifact_prefix="build/fuzz/failures/$name-")
  if [ -f "tests/fuzz/$name.dict" ]; then options+=(-dict="tests/fuzz/$name.dict"); fi
  result=passed
  nice -n 10 "build/fuzz/bin/$name" "${options[@]}" "build/fuzz/samples/$name" "tests/fuzz/corpus/$name" \
    >"$log" 2>&1 || { result="FAILED, see $log" && failed=1; }
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  printf '%-16s %12s executions in %6d s  %s\n' "$name" "${runs:-?}" "$seconds" "$result"
done
exit "$failed"

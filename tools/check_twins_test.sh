#!/usr/bin/env bash
# Shows that check_twins.sh fails on a tree where a formula stands twice.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/src/{math,view}
expect_failure() {
  if "$here/check_twins.sh" "$tree" >/dev/null 2>&1; then
    echo "check_twins_test: a twin passed: $1" >&2
    exit 1
  fi
}
printf 'LEAF(Real) half_of(Real x) { return real(0.5f) * x; }\nLEAF(Real)\nlong_name(Real x,\n          Real y) {\n' \
  >"$tree/src/math/a_leaf.h"
echo 'float other(float x) { return half_of(x); }' >"$tree/src/view/a.comp"
echo '// plumbing' >"$tree/src/view/a.glsl"
"$here/check_twins.sh" "$tree" >/dev/null

: >"$tree/src/view/a-inl.h"
expect_failure 'a shader text beside a kernel of the same name'
rm "$tree/src/view/a-inl.h"
echo 'float half_of(float x) { return 0.5 * x; }' >"$tree/src/view/a.comp"
expect_failure 'a leaf function again in a shader'
echo 'HWY_INLINE V long_name(V x, V y) {' >"$tree/src/view/a_simd.cpp"
: >"$tree/src/view/a.comp"
expect_failure 'a leaf function again in a kernel'
rm "$tree/src/view/a_simd.cpp"
echo 'LEAF(Real) half_of(Real x) { return x / real(2.0f); }' >"$tree/src/view/b_leaf.h"
expect_failure 'two leaf files with the same function'
rm "$tree/src/view/b_leaf.h"
"$here/check_twins.sh" "$tree" >/dev/null

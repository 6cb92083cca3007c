#!/usr/bin/env bash
# Checks that every formula stands once. usage: tools/check_twins.sh [FOLDER]
#
# Formulas that the CPU and shaders share are leaf files, src/**/*_leaf.h, which both read. So
# no shader text may stand beside a kernel's of the same name, and no function of a leaf file may be
# defined again elsewhere.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"
failures=0
fail() {
  printf 'twins: %s\n' "$@" >&2
  failures=$((failures + 1))
}

while IFS= read -r shader; do
  kernel="${shader%.glsl}-inl.h"
  [ -e "$kernel" ] && fail "$shader stands beside $kernel; move their formulas to a leaf file"
done < <(find src -name '*.glsl' | sort)

# Functions of leaf files: LEAF(type) name(, the type perhaps on a line of its own.
read -ra folders < <(ls -d src include 2>/dev/null | paste -sd ' ')
functions=$(find "${folders[@]}" \( -name '*_leaf.h' -o -name '*_leaf.glsl' \) -print0 | sort -z | xargs -0 -r cat | tr '\n' ' ' |
  { grep -oE 'LEAF\([A-Za-z]+\) +[a-z_0-9]+\(' || true; } | sed -E 's/LEAF\([A-Za-z]+\) +//; s/\($//' | sort)
again=$(uniq -d <<<"$functions")
[ -n "$again" ] && fail "two leaf files define the same function:" "$again"

names=$(sort -u <<<"$functions" | paste -sd '|')
# A definition begins a line: a type, the name, parameters, and a body rather than a semicolon. A
# class that passes a leaf function on says LEAF and is no definition; nor are public functions of the
# same name that call it.
if [ -n "$names" ]; then
  type='((static|inline|constexpr|HWY_INLINE|const) +)*(float|double|int|uint|bool|vec[234]|auto|void|V|M|Real|Truth|[A-Z][A-Za-z]+)&?'
  hits=$(find src \( -name '*.h' -o -name '*.cpp' -o -name '*.glsl' -o -name '*.comp' \) \
    -not -name '*_leaf.h' -not -path 'src/math/leaf*' -print0 | sort -z |
    xargs -0 -r grep -nE "^ *$type +($names)\([^;]*\{" || true)
  hits=$(grep -vE 'leaf(_scalar|_double)?::' <<<"$hits" || true)
  [ -n "$hits" ] && fail "a leaf file's function is defined again:" "$hits"
fi

if [ "$failures" -gt 0 ]; then
  exit 1
fi
echo "twins: every formula stands once"

#!/usr/bin/env bash
# Shows that check_words.sh finds each of its forms, and lets plain words pass.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree/src" "$tree/docs"

good() {
  printf '%b\n' "$2" >"$tree/$1"
  if ! "$here/check_words.sh" "$tree" >/dev/null 2>"$tree/errors"; then
    echo "check_words_test: refused although plain: $2" >&2
    cat "$tree/errors" >&2
    exit 1
  fi
  rm "$tree/$1"
}
bad() {
  printf '%b\n' "$2" >"$tree/$1"
  if "$here/check_words.sh" "$tree" >/dev/null 2>&1; then
    echo "check_words_test: passed: $2" >&2
    exit 1
  fi
  rm "$tree/$1"
}

good src/a.h '// Rotates sectors per pixel (Timonen 2013, section 11.1).'
good src/a.h '// Groups of 3x3 pixels (Timonen 2013,\n// section 10).'
good src/a.cpp 'thread = phase_of(line); // a sector of 20 degrees'
good docs/a.md 'Mean error e_A, mean |difference| in per cent of full scale: 1.2.\n\ne_A of the rest: 2.'

bad src/a.h 'float kappa = 0;'
bad src/a.glsl 'buffer Kappa { float k[]; };'
bad src/a.h '// What the contract interpolates.'
bad src/a.cpp '// What the far field is held to.'
bad docs/a.md 'What lies behind the first surface.'
bad src/a.h '"Turns segments from pixel to pixel."'
bad src/a.h '"Turns them within their width."'
bad src/a.h '"Sets directions, whatever they are."'
bad docs/a.md 'Halos behind posts and rods are gone.'
bad docs/a.md 'It no longer darkens what stands behind an object.'
bad docs/a.md 'A cost that does not know the radius.'
bad src/a.h '"Seed of everything random."'
bad src/a.h '// It runs on the processor.'
bad docs/a.md 'The truth of the world.'
bad src/a.h "// Pixels for who needs them."
bad src/a.h '// Filters to who it matters.'
bad src/a.h '// What a filter lives on.'
bad src/a.h 'int strip_phase(int sign);'
bad src/a.comp 'int start = row - d.phase;'
bad src/a.h '// Section 10: groups of pixels.'
bad docs/a.md 'Lines (section 4.1) are closed forms.'
bad docs/a.md 'The hall: e_A 1.2 %.'
echo "words: each form found"

#!/usr/bin/env bash
# Links the library's objects as a shared library and compares what it exports with exports.txt.
# usage: exports.sh LIBRARY CXX
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
library=$1 cxx=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cxx" -shared -o "$work/libobscura.so" -Wl,--whole-archive "$library" -Wl,--no-whole-archive \
  "-Wl,--version-script=$here/../../cmake/obscura.map"
# Names without arguments: methods and fields that are added do not change them.
nm -DC --defined-only "$work/libobscura.so" | cut -d ' ' -f 3- |
  sed -E 's/\[abi:[^]]*\]//; s/\(.*//' | sort -u >"$work/exports.txt"
cp "$here/exports.txt" "$work/expected.txt"
if ! grep -q '^obscura::vulkan::' "$work/exports.txt"; then # a library without Vulkan
  sed -i '/^obscura::vulkan::/d' "$work/expected.txt"
fi
diff -u "$work/expected.txt" "$work/exports.txt"

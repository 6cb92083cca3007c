#!/usr/bin/env bash
# Formatting, layering, plain words, twins and clang-tidy. usage: tools/lint.sh BUILD_FOLDER (with compile_commands.json)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=$1

mapfile -t sources < <(git ls-files '*.cpp' '*.h')
clang-format --dry-run -Werror "${sources[@]}"
echo "format: ${#sources[@]} files"

tools/check_layers.sh
tools/check_layers_test.sh
tools/check_words.sh
tools/check_words_test.sh
tools/check_twins.sh
tools/check_twins_test.sh

# Kernels (*_simd.cpp) include themselves once per SIMD target, which clang-tidy cannot follow. The
# tools' large header-only libraries take it the better part of a minute per file, so they are
# checked on request: LINT_TOOLS=1 ./run lint. It cannot read GCC's precompiled headers.
commands=$(mktemp -d)
trap 'rm -rf "$commands"' EXIT
sed -E 's/ -Winvalid-pch| -fpch-preprocess| -include [^ "]*cmake_pch\.hxx//g' \
  "$build/compile_commands.json" >"$commands/compile_commands.json"
mapfile -t units < <(git ls-files 'src/*.cpp' ${LINT_TOOLS:+'io/*.cpp' 'scene/*.cpp' 'device/*.cpp' 'reproduce/*.cpp' 'apps/*.cpp'} | grep -v '_simd\.cpp$')
printf '%s\n' "${units[@]}" |
  xargs -P "$(nproc)" -n 4 clang-tidy --quiet -p "$commands" --extra-arg=-Wno-unknown-warning-option 2>/dev/null
echo "clang-tidy: ${#units[@]} files"

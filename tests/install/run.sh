#!/usr/bin/env bash
# Installs a build tree and builds a consumer against it, with CMake and with pkg-config.
# usage: run.sh BUILD_FOLDER CXX
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1 cxx=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" >/dev/null
cmake -S "$here" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$work/build" >/dev/null
"$work/build/consumer"

pc=$(dirname "$(find "$work/prefix" -name obscura.pc)")
# shellcheck disable=SC2046
PKG_CONFIG_PATH=$pc "$cxx" -std=c++20 "$here/consumer.cpp" \
  $(PKG_CONFIG_PATH=$pc pkg-config --static --cflags --libs obscura) -o "$work/consumer"
"$work/consumer"

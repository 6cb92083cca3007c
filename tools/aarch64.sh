#!/usr/bin/env bash
# Builds the library and its unit tests for 64-bit ARM and runs them under qemu, so that the NEON
# kernels are known to be right. Needs g++-aarch64-linux-gnu and qemu-user; the ARM packages of
# Highway and GoogleTest are unpacked beside the build, nothing is installed.
# usage: tools/aarch64.sh [ctest arguments]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD/build/aarch64-root
if [ ! -e "$root/complete" ]; then
  rm -rf "$root"
  mkdir -p "$root"/apt/{lists,cache/archives}/partial "$root/packages"
  options=(-q -o APT::Architecture=arm64 -o APT::Architectures::=arm64
    -o Dir::State::Lists="$root/apt/lists" -o Dir::Cache="$root/apt/cache" -o Dir::State::status=/dev/null
    -o APT::Sandbox::User=root)
  apt-get "${options[@]}" update
  (cd "$root/packages" && apt-get "${options[@]}" download libhwy-dev libhwy1 libgtest-dev)
  for package in "$root"/packages/*.deb; do dpkg-deb -x "$package" "$root"; done
  touch "$root/complete"
fi
cmake --preset aarch64
cmake --build build/aarch64 --target obscura_tests
ctest --test-dir build/aarch64 --output-on-failure -j "$(nproc)" --no-tests=error "$@"

#!/usr/bin/env bash
# Packages for Debian 12 and an archive to unpack anywhere, in build/packages; asks lintian about them.
# usage: package.sh [CMAKE_OPTION...]   such as -DOBSCURA_BUILD_PYTHON=ON
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=$PWD/build/packages
rm -rf "$out"
mkdir -p "$out"
umask 022
log=$out/log
run() {
  if ! "$@" >>"$log" 2>&1; then
    tail -n 30 "$log" >&2
    echo "package: failed: $*" >&2
    exit 1
  fi
}

# The library is shared; the command has its own copy inside, as it also uses what the library hides.
run cmake -S . -B build/package -G Ninja -DCMAKE_BUILD_TYPE=Release -DOBSCURA_WERROR=ON \
  -DBUILD_SHARED_LIBS=ON -DOBSCURA_BUILD_TOOLS=OFF -DOBSCURA_BUILD_TESTS=OFF \
  -DCMAKE_INSTALL_PREFIX=/usr \
  -DCMAKE_INSTALL_LIBDIR="lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)" "$@"
run cmake --build build/package
run cmake --preset release
run cmake --build build/release --target obscura obscura_command obscura_manual
run cpack --config build/package/CPackConfig.cmake -G DEB -B "$out" \
  -D CPACK_INSTALL_CMAKE_PROJECTS="$PWD/build/package;obscura;LIBRARY;/;$PWD/build/release;obscura;PROGRAM;/"
# CPack calls ldconfig in scripts; Debian's policy has a trigger for it.
library=$(echo "$out"/libobscura0*.deb)
run dpkg-deb -R "$library" "$out/library"
rm "$out"/library/DEBIAN/post{inst,rm}
echo 'activate-noawait ldconfig' >"$out/library/DEBIAN/triggers"
run dpkg-deb --root-owner-group -b "$out/library" "$library"
rm -r "$out/library"
run cpack --config build/release/CPackConfig.cmake -G TZST -B "$out" \
  -D CPACK_INSTALL_CMAKE_PROJECTS="$PWD/build/release;obscura;ALL;/"
rm -rf "$out/_CPack_Packages"

(cd "$out" && ls -s --block-size=K ./*.deb ./*.tar.zst)
lintian --allow-root --fail-on error,warning --tag-display-limit 0 "$out"/*.deb
echo "lintian: no errors, no warnings"

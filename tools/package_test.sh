#!/usr/bin/env bash
# Installs build/packages (tools/package.sh) in a bare Debian 12 and uses them there; needs root and
# Debian's archive.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
packages=$PWD/build/packages
if [ "$(id -u)" -ne 0 ]; then
  echo "package_test: skipped, since debootstrap needs root"
  exit 0
fi
root=$(mktemp -d)
log=$root.log
clean_up() {
  umount "$root/proc" 2>/dev/null || true
  rm -rf "$root" "$log"
}
trap clean_up EXIT
chmod 755 "$root"
quietly() {
  if ! "$@" >"$log" 2>&1; then
    tail -n 30 "$log" >&2
    echo "package_test: failed: $*" >&2
    exit 1
  fi
}
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 "$@"; }

# The archive from which this machine has its packages.
mirror=$(sed -nE 's/^(deb|URIs:)( \[[^]]*\])? *(https?:[^ ]*debian\/?)( .*)?$/\3/p' \
  /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | head -n 1 || true)
quietly debootstrap --variant=minbase bookworm "$root" "${mirror:-http://deb.debian.org/debian}"
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
# Proxies and certificates of this machine, if it has any.
cp /etc/apt/apt.conf.d/*proxy* "$root/etc/apt/apt.conf.d/" 2>/dev/null || true
mkdir "$root/packages"
cp "$packages"/*.deb "$root/packages"
cp -r tests/install "$root/consumer"
mount -t proc proc "$root/proc" 2>/dev/null || true
install="apt-get install -y -q --no-install-recommends -o Dpkg::Use-Pty=0"
quietly inside sh -c "apt-get update -q"

# The command with nothing else: a picture, its manual page, a method's name completed.
quietly inside sh -c "$install /packages/obscura_*.deb"
quietly inside obscura ao 'scene:bump?size=64x36' --method line -o /v.exr
inside sh -c 'test -s /v.exr && gzip -t /usr/share/man/man1/obscura-ao.1.gz'
inside bash -c 'source /usr/share/bash-completion/completions/obscura
  COMP_WORDS=(obscura ao d.exr --method far) COMP_CWORD=4
  _obscura
  [ "${COMPREPLY[*]}" = far-field ]'

# The library for programs: find_package and pkg-config, with no other development package.
quietly inside sh -c "$install g++ cmake make pkg-config /packages/libobscura*.deb"
quietly inside sh -c 'cmake -S /consumer -B /build && cmake --build /build && /build/consumer'
quietly inside sh -c 'g++ -std=c++20 /consumer/consumer.cpp $(pkg-config --cflags --libs obscura) \
  -o /consumer/program && /consumer/program'
quietly inside sh -c "$install /packages/obscura-doc_*.deb"
for python in "$packages"/python3-obscura_*.deb; do
  [ -e "$python" ] || continue
  quietly inside sh -c "$install /packages/python3-obscura_*.deb"
  quietly inside python3 -c 'import obscura; print(obscura.__file__)'
done
# They leave as they came.
quietly inside sh -c "apt-get remove -y -q 'libobscura*' 'obscura*' '*obscura*'"
inside sh -c 'test ! -e /usr/bin/obscura && test ! -e /usr/include/obscura'

# The archive runs wherever it is unpacked, where its libraries are.
mkdir "$root/moved"
tar --zstd -xf "$packages"/obscura-*.tar.zst -C "$root/moved" --strip-components=1
quietly inside /moved/bin/obscura ao 'scene:bump?size=64x36' --method line -o /w.exr
cmp "$root/v.exr" "$root/w.exr"
echo "packages: installed, used and removed in a bare Debian 12"

#!/usr/bin/env bash
# Makes the images of this folder again, some minutes: the references that tests hold methods against,
# by the project's own tracers with 16,384 rays, which are themselves tested against closed forms and
# an independent tracer. usage: tests/truth/make.sh [OBSCURA]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
obscura=${1:-../../build/release/bin/obscura}
"$obscura" ao scene:hall --method ray-traced --rays 16384 --every 5 --radius 2 -o hall.exr
"$obscura" ao scene:meadow --method ray-traced --rays 16384 --every 5 --radius 1 -o meadow.exr
"$obscura" ao scene:tower --method ray-traced --rays 16384 --every 7 --radius 1 \
  --outputs visibility,bent-normal,cone-angle -o tower.exr
"$obscura" volume volume:gyroid --method monte-carlo --rays 16384 --size 64x64 \
  --samples-per-pixel 1 --eye 1.794695767540157,2.8539923046184668,1.55929653707831 \
  --look-at 0.5,0.5,0.5 -o gyroid.exr

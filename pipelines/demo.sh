#!/usr/bin/env bash
# Goes from a bare machine to a night picture: installs packages, builds, makes the default town, bakes it, renders
# it. A second run redoes only what is missing or out of date. The last lines name the picture.
set -euo pipefail
# shellcheck source=pipelines/steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/steps.sh"

cd "$root"
out=out/demo
nightbake=build/release/nightbake
nightview=build/release/nightview
this=pipelines/demo.sh  # every step depends on the options written here

timed "packages" pipelines/setup.sh
timed "programs (the first build takes minutes)" pipelines/build.sh release nightbake nightview
mkdir -p "$out"

if ! up_to_date "$out/town/town.toml" "$nightbake" "$this"; then
  timed "town" "$nightbake" town --out "$out/town"
fi
if ! up_to_date "$out/city.glb" "$nightbake" "$this" "$out"/town/*; then
  timed "bake" "$nightbake" run "$out/town/town.toml" --out "$out"
fi
if ! up_to_date "$out/night.png" "$nightview" "$this" "$out/city.glb" "$out/city.lights"; then
  timed "picture" "$nightview" render "$out/city.glb" -o "$out/night.png" --size 960x540 --frames 4 --candidates 16 --denoise --camera overview --sky 0.01
fi

say "done: $out/night.png"
cat <<TEXT
Next, on a machine with a screen:
  $nightview $out/city.glb
or render a street, as PNG and in cd/m2:
  $nightview render $out/city.glb -o $out/street.png -o $out/street.exr --size 960x540 --camera street --sky 0.01
TEXT

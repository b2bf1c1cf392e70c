#!/usr/bin/env bash
# Other programs open a baked city: the Khronos validator finds no error, three.js and Blender show all of it.
#   viewers_test.sh NIGHTBAKE [RECIPE...]
# A small town is always tested; RECIPEs are baked in addition, as they are and with Draco.
# NODE_MODULES names a folder with gltf-validator, three and draco3dgltf (npm install --prefix FOLDER ...), BLENDER a
# Blender (default: blender). Programs that are missing are left out; without any of them the test is skipped (77).
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
nightbake=$1
blender=${BLENDER:-blender}
modules=${NODE_MODULES:-}
has_node=no
has_blender=no
[[ -n $modules && -d $modules/gltf-validator && -d $modules/three && -d $modules/draco3dgltf ]] && command -v node >/dev/null && has_node=yes
# Blender's importer needs numpy, which Debian's package of Blender only recommends.
command -v "$blender" >/dev/null && "$blender" --background --factory-startup --python-exit-code 3 \
  --python-expr 'import numpy' >/dev/null 2>&1 && has_blender=yes
if [[ $has_node = no && $has_blender = no ]]; then
  echo "neither NODE_MODULES nor Blender with numpy: nothing to open a scene with"
  exit 77
fi
scratch=$(mktemp -d)
beside=() # temporary recipes beside the given ones, because paths in them are relative
trap 'rm -rf "$scratch" "${beside[@]}"' EXIT
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# Three scenes: geometry alone, with lamps and windows, and geometry with Draco. Without the horizon, which other programs
# see and `inspect` does not count into a scene's bounds.
"$nightbake" --quiet town --blocks 4 --out "$scratch" >/dev/null || exit 1
horizon="[ground]\nhorizon = false\n"
head="[city]\nfiles = [\"town.gml\"]\n$horizon"
printf '%b[windows]\nlit = false\n' "$head" >"$scratch/plain.toml"
printf '%b[windows]\nlit = false\n[output]\ndraco = true\n' "$head" >"$scratch/draco.toml"
{ cat "$scratch/town.toml"; printf '%b' "$horizon"; } >"$scratch/lights.toml"
declare -A inspected
for name in plain draco lights; do
  "$nightbake" --quiet run "$scratch/$name.toml" --out "$scratch/$name" >/dev/null || exit 1
  inspected[$name]=$("$nightbake" inspect --json "$scratch/$name/city.glb")
done
value() { python3 -c 'import json, sys; print(json.load(sys.stdin)[sys.argv[1]])' "$2" <<<"${inspected[$1]}"; }

# same_box NAME OUTPUT: the bounds at the end of OUTPUT ("min x y z max x y z", y up) are those of inspect, within 2 cm.
same_box() {
  python3 -c '
import json, sys
expected = json.load(sys.stdin)["bbox_model"]
words = sys.argv[1].split()
found = [float(v) for v in words[words.index("min") + 1:][:3] + words[words.index("max") + 1:][:3]]
if "z-up" in sys.argv[2:]:  # Blender: x, -z, y of glTF
    found = [found[0], found[2], -found[4], found[3], found[5], -found[1]]
sys.exit(any(abs(a - b) > 0.02 for a, b in zip(expected, found)))' "${@:2}" <<<"${inspected[$1]}"
}

recipes=()
for recipe in "${@:2}"; do
  name=$(basename "$recipe" .toml)
  recipes+=("$name")
  "$nightbake" --quiet run "$recipe" --out "$scratch/$name" >/dev/null || fail "$name cannot be baked"
  inspected[$name]=$("$nightbake" inspect --json "$scratch/$name/city.glb")
done

if [[ $has_node = yes ]]; then
  for recipe in "${@:2}"; do
    folder=$(cd "$(dirname "$recipe")" && pwd)
    name=$(basename "$recipe" .toml)
    beside+=("$folder/.viewers-$name.toml")
    { cat "$recipe" && printf '\n[output]\ndraco = true\n'; } >"$folder/.viewers-$name.toml"
    "$nightbake" --quiet run "$folder/.viewers-$name.toml" --out "$scratch/$name-draco" >/dev/null || fail "$name with Draco cannot be baked"
    node "$here/../../pipelines/validate_gltf.mjs" "$scratch/$name"{,-draco}/city.glb || fail "the validator finds errors in $name"
    for file in "$scratch/$name"{,-draco}/city.glb; do
      NODE_MODULES=$modules node "$here/open_in_three.mjs" "$file" || fail "three.js refuses $file"
    done
  done
  node "$here/../../pipelines/validate_gltf.mjs" "$scratch"/{plain,draco,lights}/city.glb || fail "the validator finds errors"
  # Tiles of 3D Tiles are glTF like any other.
  "$nightbake" --quiet export "$scratch/lights" -o "$scratch/tiles" >/dev/null || fail "the town has no 3D Tiles"
  node "$here/../../pipelines/validate_gltf.mjs" "$scratch"/tiles/tiles/*.glb || fail "the validator finds errors in tiles"
  for name in plain draco lights; do
    out=$(NODE_MODULES=$modules node "$here/open_in_three.mjs" "$scratch/$name/city.glb") || fail "three.js refuses $name"
    echo "three.js, $name: $out"
    [[ $out = *"triangles $(value $name triangles_shown) "* ]] || fail "three.js shows other triangles of $name"
    same_box $name "$out" || fail "three.js shows $name elsewhere"
  done
else
  echo "no NODE_MODULES with gltf-validator, three and draco3dgltf: validator and three.js left out"
fi

if [[ $has_blender = yes ]]; then
  # Debian's Blender has no Draco decoder.
  for name in plain lights "${recipes[@]}"; do
    out=$("$blender" --background --factory-startup --python-exit-code 3 --python "$here/open_in_blender.py" -- \
      "$scratch/$name/city.glb" 2>"$scratch/err" | grep '^meshes') || fail "Blender refuses $name: $(tail -3 "$scratch/err")"
    echo "Blender, $name: $out"
    [[ $out = *"triangles $(python3 "$here/count_for_blender.py" "$scratch/$name/city.glb") "* ]] ||
      fail "Blender shows other triangles of $name"
    [[ $name != plain ]] || same_box "$name" "$out" z-up || fail "Blender shows $name elsewhere"
  done
else
  echo "no Blender with numpy: left out"
fi
exit $((failures > 0))

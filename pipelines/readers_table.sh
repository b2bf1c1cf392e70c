#!/usr/bin/env bash
# Makes docs/readers.md: what the CityGML readers do with every real file, how fast they and whole bakes are.
#   pipelines/readers_table.sh BUILD_FOLDER DATA_FOLDER > docs/readers.md
# Wants an idle machine.
# BUILD_FOLDER holds nightbake and reader_bench. Writes some 4 GB below $TMPDIR for the synthetic cities and removes it.
# SIZES="buildings..." of the synthetic cities; SIZES="" leaves them out. The first is read by libcitygml too.
set -euo pipefail

build=$1
data=$2
sizes=${SIZES-2400 24000 101000}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

megabytes() { stat -Lc %s "$@" | awk '{ sum += $1 } END { printf "%.0f", sum / 1e6 }'; }

# One row of a bake.
bake_row() {
  local name=$1 recipe=$2 threads=$3
  /usr/bin/time -f '%e %U %S %M' -o "$scratch/time" "$build/nightbake" --quiet run "$recipe" --json --threads "$threads" \
    --out "$scratch/out" >"$scratch/report.json"
  python3 - "$name" "$threads" "$scratch/report.json" "$scratch/time" <<'PYTHON'
import json, sys
name, threads, report, time = sys.argv[1:]
report = json.load(open(report))
seconds, user, system, kilobytes = map(float, open(time).read().split()[-4:])
megabytes = report["input_bytes"] / 1e6
print(f"| {name} | {megabytes:.0f} | {threads} | {report['citygml']['objects']} | {report['scene']['triangles']} | {seconds:.1f} "
      f"| {user + system:.1f} | {megabytes / seconds:.1f} | {kilobytes / 1024:.0f} | {report['scene']['bytes'] / 1e6:.0f} |")
PYTHON
  rm -rf "$scratch/out"
}

cat <<TEXT
# What the readers do with every real file

Made by \`pipelines/readers_table.sh BUILD DATA > docs/readers.md\` on $(date -u +%F): $(nproc) cores of
$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(uname -m), load average $(cut -d' ' -f1 /proc/loadavg) when it began.

## Every file, both readers

One thread, warm cache, best of several rounds; ms and MB/s are of CPU time, which other work on the machine does not
disturb. "not used" polygons are each in the report with their reason; "times libcitygml" is its time over the stream
reader's. The last column is what else the file held and nobody used, most frequent
first: \`nightbake inspect FILE\` has all of it.

| file | MB | version | objects | polygons | not used | CPU ms | MB/s | times libcitygml | peak MB | peak MB, libcitygml | polygons, libcitygml | skipped |
|---|---|---|---|---|---|---|---|---|---|---|---|---|
TEXT
mapfile -t files < <(find "$data" \( -name '*.gml' -o -name '*.xml' -o -name '*.citygml' \) -size +0 | LC_ALL=C sort)
"$build/reader_bench" --markdown --rounds 2 "${files[@]}" | sed "s|$data/||g"

cat <<'TEXT'

## Large files, one thread and two

The same with cities that `nightbake town` writes (LoD2, terrain, roads, trees).

TEXT
stream_only=
for buildings in $sizes; do
  "$build/nightbake" --quiet town --buildings "$buildings" --out "$scratch/town$buildings" >&2
  echo '```'
  "$build/reader_bench" "$scratch/town$buildings/town.gml" --rounds 1 $stream_only | sed "s|$scratch/||"
  stream_only=--stream-only
  echo '```'
done

cat <<'TEXT'

## Whole bakes

From CityGML and map to city.glb and city.lights. The synthetic cities once with their lamps and lit windows and once as
"geometry": windows off.

| city | MB of CityGML | threads | objects | triangles | s | CPU s | MB/s | peak RSS, MB | city.glb, MB |
|---|---|---|---|---|---|---|---|---|---|
TEXT
for recipe in berlin nrw osaka; do
  [[ -f pipelines/$recipe.toml ]] && bake_row "$recipe" "pipelines/$recipe.toml" 2
done
for buildings in $sizes; do
  town=$scratch/town$buildings
  printf '\n[windows]\nlit = false\n' | cat "$town/town.toml" - >"$town/dark.toml"
  name="town, $(megabytes "$town/town.gml") MB"
  bake_row "$name, geometry" "$town/dark.toml" 1
  bake_row "$name, geometry" "$town/dark.toml" 2
  bake_row "$name" "$town/town.toml" 2
done

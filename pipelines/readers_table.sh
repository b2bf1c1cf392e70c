#!/usr/bin/env bash
# Makes docs/measurements/DATE-readers.md: what both CityGML readers do with every real file, and time and memory of the
# readers and of whole bakes.
#   pipelines/readers_table.sh BUILD_FOLDER DATA_FOLDER > docs/measurements/DATE-readers.md
# BUILD_FOLDER holds nightbake and reader_bench. Needs an idle machine, some ten minutes, and 4 GB below $TMPDIR for the
# synthetic cities, which it removes. Prints its progress on stderr. SIZES sets the numbers of buildings of the synthetic
# cities (SIZES="" leaves them out); libcitygml reads only the first of them.
set -euo pipefail

if (($# != 2)); then
  sed -n '2,7s/^# \?//p' "$0" >&2
  exit 2
fi
build=$1
data=$2
sizes=${SIZES-2400 24000 101000}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

say() { printf '%4d s  %s\n' "$SECONDS" "$*" >&2; }
load() { cut -d' ' -f1 /proc/loadavg; }
megabytes() { stat -Lc %s "$@" | awk '{ sum += $1 } END { printf "%.0f", sum / 1e6 }'; }

# Prints one row of the table of bakes, with the checksum of both files.
bake_row() {
  local name=$1 recipe=$2 threads=$3
  say "bake: $name, $threads threads"
  /usr/bin/time -f '%e %U %S' -o "$scratch/time" "$build/nightbake" --quiet run "$recipe" --json --threads "$threads" \
    --out "$scratch/out" >"$scratch/report.json"
  sum=$(cat "$scratch/out/city.glb" "$scratch/out/city.lights" | md5sum | cut -c1-8)
  rm -rf "$scratch/out"
  python3 - "$name" "$threads" "$sum" "$scratch/report.json" "$scratch/time" <<'PYTHON'
import json, sys
name, threads, checksum, report, time = sys.argv[1:]
report = json.load(open(report))
seconds, user, system = map(float, open(time).read().split()[-3:])
megabytes = report["input_bytes"] / 1e6
lights = report["windows"]["placed"] + report["lamps"]["placed"]
print(f"| {name} | {megabytes:.0f} | {threads} | {report['citygml']['objects']} | {report['scene']['triangles']} | {lights} "
      f"| {seconds:.1f} | {user + system:.1f} | {megabytes / seconds:.1f} | {max(report['peak_mb'].values()):.0f} "
      f"| {report['scene']['bytes'] / 1e6:.0f} | {checksum} |")
PYTHON
}

cat <<TEXT
# What the readers do with every real file

Made by \`pipelines/readers_table.sh BUILD DATA > docs/measurements/DATE-readers.md\` on $(date -u +%F): $(nproc) cores of
$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(uname -m), load average $(load) when it began.

## Every file, both readers

One thread, warm cache, best of several rounds; ms and MB/s are of CPU time, which other work on the machine disturbs
little. Each "not used" polygon is in the report with its reason; "times libcitygml" is its time divided by the stream
reader's. The last column lists what else the file holds and is not used, most frequent first: \`nightbake inspect FILE\`
has all of it.

| file | MB | version | objects | polygons | not used | CPU ms | MB/s | times libcitygml | peak MB | peak MB, libcitygml | polygons, libcitygml | skipped |
|---|---|---|---|---|---|---|---|---|---|---|---|---|
TEXT
mapfile -t files < <(find "$data" \( -name '*.gml' -o -name '*.xml' -o -name '*.citygml' \) -size +0 | LC_ALL=C sort)
say "${#files[@]} real files, both readers"
"$build/reader_bench" --markdown --rounds 2 "${files[@]}" | sed "s|$data/||g"

cat <<'TEXT'

## Large files, one thread and two

The same with cities that `nightbake town` writes (LoD2, terrain, roads, trees); MB/s of wall time.

TEXT
stream_only=
for buildings in $sizes; do
  say "town of $buildings buildings"
  "$build/nightbake" --quiet town --buildings "$buildings" --out "$scratch/town$buildings" >&2
  say "readers: $(megabytes "$scratch/town$buildings/town.gml") MB"
  echo '```'
  "$build/reader_bench" "$scratch/town$buildings/town.gml" --rounds 1 $stream_only | sed "s|$scratch/||"
  stream_only=--stream-only
  echo '```'
done

cat <<'TEXT'

## Whole bakes

From CityGML and map to city.glb and city.lights; `nightbake run RECIPE --threads N`. The synthetic cities with lamps and
lit windows, and once as "geometry": without windows; all without traffic, which `DATE-traffic.md` measures. "peak MB" is
the most memory resident at any time. A city gives the same bytes on one thread and on two: "md5" is of both files.
What grows with a city is its map and the lamps along its streets, which are held in memory; CityGML, walls, windows and
triangles are not. Without a map, streets are made from the model's own roads, all at once: 820 MB for 2.5 GB of town (`DATE-traffic.md`).

| city | MB of CityGML | threads | objects | triangles | lamps and windows | s | CPU s | MB/s | peak MB | city.glb, MB | md5 |
|---|---|---|---|---|---|---|---|---|---|---|---|
TEXT
for recipe in berlin nrw osaka; do
  [[ -f pipelines/$recipe.toml ]] && bake_row "$recipe" "pipelines/$recipe.toml" 2
done
for buildings in $sizes; do
  town=$scratch/town$buildings
  sed '/^\[traffic\]/d' "$town/town.toml" >"$town/lights.toml"
  printf '\n[windows]\nlit = false\n' | cat "$town/lights.toml" - >"$town/dark.toml"
  name="town, $(megabytes "$town/town.gml") MB"
  bake_row "$name, geometry" "$town/dark.toml" 2
  bake_row "$name" "$town/lights.toml" 1
  bake_row "$name" "$town/lights.toml" 2
  rm -rf "$town"
done
printf '\nLoad average %s when the last bake ended.\n' "$(load)"
say "done"

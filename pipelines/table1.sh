#!/usr/bin/env bash
# Table 1 of "Rendering Night Cities" (CESCG 2025), remade: 1 to 40 candidates, 5 neighbours, with the paper's weights and
# with our default, on two towns of about the size of its scenes (304,000 triangles and 337 lamps; 311,000 and 913; ours
# have 303,000 triangles each).
#   pipelines/table1.sh [--out DIR] [--size WIDTHxHEIGHT] [--minutes N] [--device NAME] [--build DIR]
#                       [--reference-frames N]
# Stopped or out of its minutes, it goes on where it was when run again. Where nightbake is not built, DIR/small and
# DIR/large must hold the baked towns. DIR gets table1.md, and sweep.csv, sweep.md and a plot for each town.
set -euo pipefail
# shellcheck source=pipelines/steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/steps.sh"

out=$root/out/table1
size=1920x1080
minutes=0
reference_frames=64
device=
build=$root/build/release
while [ $# -gt 0 ]; do
  case $1 in
    --out) out=$2 ;;
    --size) size=$2 ;;
    --minutes) minutes=$2 ;;
    --reference-frames) reference_frames=$2 ;;
    --device) device=$2 ;;
    --build) build=$2 ;;
    *) fail 2 "no option $1 (see the head of this file)" ;;
  esac
  shift 2
done
mkdir -p "$out"

# town NAME TRIANGLES LAMPS: asked for TRIANGLES, a town has some 6 % fewer once it is baked.
town() {
  local folder=$out/$1
  if stands "$folder/city.glb"; then return; fi
  "$build/nightbake" town --out "$folder" --triangles "$2" --lamps "$3"
  # The recipe ends in [traffic]; the paper's scenes have neither traffic nor windows.
  printf 'drives = false\n[lamps]\nlayout = "never"\n[windows]\nlit = false\n' >>"$folder/town.toml"
  "$build/nightbake" run "$folder/town.toml" --out "$folder"
}

# sweep NAME: half of the time each.
sweep() {
  "$build/nightview" sweep "$out/$1/city.glb" --out "$out/$1/sweep" --size "$size" --views overview --frames 30 \
    --estimator paper,traced --candidates 1,2,4,8,16,24,32,40 --neighbours 5 \
    --reference-frames "$reference_frames" \
    --minutes "$(awk "BEGIN { print $minutes / 2 }")" ${device:+--device "$device"}
}

# table NAME TITLE: one line a number of candidates, the paper's figures beside ours.
table() {
  printf '\n%s, %s, mean of 30 frames, on %s\n\n' "$2" "$size" \
    "$(awk -F, 'NR == 2 { print $4 }' "$out/$1/sweep/sweep.csv")"
  awk -F, -v size="$size" '
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    $at["size"] == size {
      key = $at["estimator"] " " $at["candidates"]
      known[$at["candidates"]] = 1
      line[key] = sprintf("%.3g | %.2f | %.3g | %+.2f |", $at["ms"], $at["rmse8"], $at["relative_mse"],
                          100 * $at["relative_mean_signed_error"])
    }
    END {
      print "| candidates | paper: ms | RMSE | relative MSE | mean error, % | traced: ms | RMSE | relative MSE | mean error, % |"
      print "|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
      for (n = 1; n <= 1024; ++n)
        if (n in known)
          print "| " n " | " (("paper " n) in line ? line["paper " n] : "| | | |") " " \
                (("traced " n) in line ? line["traced " n] : "| | | |")
    }' "$out/$1/sweep/sweep.csv"
}

timed "town with 337 lamps" town small 325000 337
timed "town with 913 lamps" town large 325000 913
timed "337 lamps" sweep small
timed "913 lamps" sweep large
{ table small "337 lamps" && table large "913 lamps"; } >"$out/table1.md.part"
mv "$out/table1.md.part" "$out/table1.md"
cat "$out/table1.md"

#!/usr/bin/env bash
# Makes Table 1 of "Rendering Night Cities" (CESCG 2025) anew: 1 to 40 candidates, with the paper's weights and 5 neighbours
# within 10 pixels, and with our default estimator. The two towns are about as large as the paper's scenes (304,000 triangles and
# 337 lamps; 311,000 and 913); ours have 303,000 triangles each.
#   pipelines/table1.sh [--out DIR] [--size WIDTHxHEIGHT] [--minutes N] [--device NAME] [--build DIR]
#                       [--reference-frames N]
# When it was stopped, or its minutes were used up, the next run continues. If nightbake is not built, DIR/small and
# DIR/large must hold the baked towns. Writes DIR/table1.md, and sweep.csv, sweep.md and a plot for each town.
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

# town NAME TRIANGLES LAMPS: a baked town has some 6 % fewer triangles than asked for.
town() {
  local folder=$out/$1
  if up_to_date "$folder/city.glb"; then return; fi
  "$build/nightbake" town --out "$folder" --triangles "$2" --lamps "$3"
  # The recipe ends with [traffic]. The paper's scenes have neither traffic nor windows.
  printf 'drives = false\n[lamps]\nlayout = "never"\n[windows]\nlit = false\n' >>"$folder/town.toml"
  "$build/nightbake" run "$folder/town.toml" --out "$folder"
}

# sweep NAME: each town gets half of the time, and each estimator half of that.
sweep() {
  measured() {
    "$build/nightview" sweep "$out/$1/city.glb" --out "$out/$1/sweep" --size "$size" --views overview --frames 30 \
      --candidates 1,2,4,8,16,24,32,40 --reference-frames "$reference_frames" \
      --minutes "$(awk "BEGIN { print $minutes / 4 }")" ${device:+--device "$device"} "${@:2}"
  }
  measured "$1" --estimator paper --neighbours 5 --radius 10
  measured "$1" --estimator traced --neighbours 2
}

# table NAME TITLE: one line for each number of candidates, the paper's weights beside our default.
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

#!/usr/bin/env bash
# Runs every fuzzer for a while, then tests with sanitizers: tests/fuzz.sh [ci | SECONDS [FUZZER...]]
# SECONDS: for each fuzzer (60), as many at once as there are cores. FUZZER: archive, areas, camera, citygml, cityjson,
# elevation, exr, glb, inventory, lights, luminaire, obj, obj_pictures, osm, picture, recipe, settings, tags or triangulation
# (all, and then all tests). ci: a minute of each fuzzer, then the tests of the readers, which are linked with what the fuzzers
# have built. That build takes some twenty minutes on two cores with an empty ccache. Needs clang. What a fuzzer finds lies in
# build/fuzz/found, and the script ends with 1; inputs that reach new code are kept in build/fuzz/corpus from run to run.
# FUZZ_NICE=19 leaves the machine to others.
set -euo pipefail
# shellcheck source=pipelines/steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/../pipelines/steps.sh"

mode=all
case "${1:-}" in
  ci) mode=ci seconds=60 ;;
  *) seconds=${1:-60} ;;
esac
[ $# -eq 0 ] || shift
[ $# -eq 0 ] || mode=some
cd "$root"

declare -A seeds=(
  [archive]=tests/tools/inputs/corpus
  [areas]=tests/tools/osm/corpus
  [camera]=tests/runtime/scene/corpus
  [citygml]=tests/tools/citygml/corpus
  [cityjson]=tests/tools/cityjson/corpus
  [elevation]=tests/tools/terrain/corpus
  [exr]=tests/runtime/measure/corpus
  [glb]=tests/formats/corpus/glb
  [inventory]=tests/tools/inventory/corpus
  [lights]=tests/formats/corpus/lights
  [luminaire]=tests/tools/lights/corpus
  [obj]=tests/tools/obj/corpus
  [obj_pictures]=tests/tools/obj/corpus_pictures
  [osm]=tests/tools/osm/corpus
  [picture]=tests/formats/corpus/picture
  [recipe]=tests/tools/bake/corpus
  [scene]=tests/runtime/scene/corpus_scenes
  [settings]=tests/runtime/render/corpus
  [tags]=tests/tools/lights/corpus_tags
  [triangulation]=tests/tools/streets/corpus
)
# The libraries that the fuzzers have built already.
readers=(formats citygml cityjson obj osm mesh streets terrain)
fuzzers=("$@")
if [ ${#fuzzers[@]} -eq 0 ]; then mapfile -t fuzzers < <(printf '%s\n' "${!seeds[@]}" | sort); fi

targets=("${fuzzers[@]/%/_fuzz}")
[ "$mode" != ci ] || targets+=("${readers[@]/#/test_}")
timed "fuzzers, by clang with sanitizers" pipelines/build.sh fuzz "${targets[@]}"

# The tests' suppressions: what libraries lose is not for us to free.
export LSAN_OPTIONS=suppressions=$root/tests/leaks.supp:print_suppressions=0
export UBSAN_OPTIONS=print_stacktrace=1

# Ends with 1 where the fuzzer has found something.
run_fuzzer() {
  local name=$1 log=build/fuzz/$1.log found=0
  mkdir -p "build/fuzz/corpus/$name" "build/fuzz/found/$name"
  nice -n "${FUZZ_NICE:-0}" "build/fuzz/${name}_fuzz" "build/fuzz/corpus/$name" "${seeds[$name]}" \
    -artifact_prefix="build/fuzz/found/$name/" -max_total_time="$seconds" -max_len=65536 -timeout=20 -rss_limit_mb=2048 \
    -print_final_stats=1 >"$log" 2>&1 || found=1
  awk -v name="$name" '/^stat::number_of_executed_units/ { runs = $2 } /^stat::average_exec_per_sec/ { rate = $2 }
       / cov: / { for (i = 1; i < NF; i++) { if ($i == "cov:") cov = $(i + 1); if ($i == "ft:") ft = $(i + 1) } }
       END { printf "%-14s %10d runs %8d a second %7d edges %7d features\n", name, runs, rate, cov, ft }' "$log"
  [ "$found" -eq 0 ] || echo "FOUND: $(grep -m1 -E 'ERROR|SUMMARY|Test unit written' "$log"), see $log"
  return "$found"
}

say "${#fuzzers[@]} fuzzers, $seconds s each"
failures=0 running=0
for name in "${fuzzers[@]}"; do
  if [ "$running" -ge "$(nproc)" ]; then
    wait -n || failures=$((failures + 1))
    running=$((running - 1))
  fi
  run_fuzzer "$name" &
  running=$((running + 1))
done
for ((; running > 0; running--)); do wait -n || failures=$((failures + 1)); done
[ "$failures" -eq 0 ] || exit 1

if [ "$mode" = ci ]; then
  pattern=$(printf '|%s' "${readers[@]}")
  exec ctest --test-dir build/fuzz --output-on-failure --parallel "$(nproc)" -R "^(${pattern#|})\\."
fi
if [ "$mode" = all ]; then
  timed "programs and tests with sanitizers" pipelines/build.sh asan
  exec ctest --test-dir build/asan --output-on-failure --parallel "$(nproc)"
fi

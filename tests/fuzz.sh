#!/usr/bin/env bash
# Runs every fuzzer for a while, then all tests with sanitizers: tests/fuzz.sh [SECONDS [FUZZER...]]
# SECONDS: for each fuzzer (60). FUZZER: citygml, cityjson, glb, lights, obj, osm, picture, recipe or triangulation (all, and then
# the tests).
# Needs clang. What a fuzzer finds lies in build/fuzz/found, and the script ends with 1; inputs that reach new code are kept
# in build/fuzz/corpus from run to run. FUZZ_NICE=19 leaves the machine to others.
set -euo pipefail
# shellcheck source=pipelines/steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/../pipelines/steps.sh"

seconds=${1:-60}
[ $# -eq 0 ] || shift
cd "$root"

declare -A seeds=(
  [citygml]=tests/tools/citygml/corpus
  [cityjson]=tests/tools/cityjson/corpus
  [glb]=tests/formats/corpus/glb
  [lights]=tests/formats/corpus/lights
  [obj]=tests/tools/obj/corpus
  [osm]=tests/tools/osm/corpus
  [picture]=tests/formats/corpus/picture
  [recipe]=tests/tools/bake/corpus
  [triangulation]=tests/tools/streets/corpus
)
fuzzers=("$@")
if [ ${#fuzzers[@]} -eq 0 ]; then mapfile -t fuzzers < <(printf '%s\n' "${!seeds[@]}" | sort); fi

timed "fuzzers, by clang with sanitizers" pipelines/build.sh fuzz "${fuzzers[@]/%/_fuzz}"

# The tests' suppressions: what libraries lose is not for us to free.
export LSAN_OPTIONS=suppressions=$root/tests/leaks.supp:print_suppressions=0
export UBSAN_OPTIONS=suppressions=$root/tests/ubsan.supp:print_stacktrace=1
failures=0
for name in "${fuzzers[@]}"; do
  say "$name: $seconds s"
  mkdir -p "build/fuzz/corpus/$name" "build/fuzz/found/$name"
  log=build/fuzz/$name.log
  if ! nice -n "${FUZZ_NICE:-0}" "build/fuzz/${name}_fuzz" "build/fuzz/corpus/$name" "${seeds[$name]}" \
    -artifact_prefix="build/fuzz/found/$name/" -max_total_time="$seconds" -max_len=65536 -timeout=10 -rss_limit_mb=2048 \
    -print_final_stats=1 >"$log" 2>&1; then
    echo "FOUND: $(grep -m1 -E 'ERROR|SUMMARY|Test unit written' "$log"), see $log"
    failures=$((failures + 1))
  fi
  awk '/^stat::(number_of_executed_units|average_exec_per_sec)/ { printf "  %s %s\n", $1, $2 }
       /cov: / { line = $0 } END { sub(/.*cov:/, "  cov:", line); print line }' "$log"
done
[ "$failures" -eq 0 ] || exit 1

if [ $# -eq 0 ]; then
  timed "programs and tests with sanitizers" pipelines/build.sh asan
  exec ctest --test-dir build/asan --output-on-failure --parallel "$(nproc)"
fi

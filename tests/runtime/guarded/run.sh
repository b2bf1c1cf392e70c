#!/usr/bin/env bash
# Runs the tests of the device with guard pages behind its memory, on Mesa's CPU driver: tests/runtime/guarded/run.sh [PROGRAM...]
# PROGRAM: test_render, test_viewer, test_experiments, test_nightview or test_proof (all of them, half an hour on two cores). A
# shader that goes beyond a buffer ends its program with a line "guard pages: access at byte ... of a block of ... bytes".
set -euo pipefail
# shellcheck source=pipelines/steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../../pipelines/steps.sh"

cd "$root"
programs=("$@")
[ ${#programs[@]} -gt 0 ] || programs=(test_render test_viewer test_experiments test_nightview test_proof)
pipelines/build.sh release guard_pages nightview nightbake "${programs[@]}"
failed=0
for program in "${programs[@]}"; do
  say "$program"
  LD_PRELOAD=$root/build/release/libguard_pages.so "build/release/$program" || failed=1
done
exit "$failed"

#!/usr/bin/env bash
# Installs, builds and runs every test. Arguments go to ctest (tests/run.sh -R mesh); the last lines are its summary.
set -euo pipefail
# shellcheck source=pipelines/steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/../pipelines/steps.sh"

cd "$root"
timed "packages" pipelines/setup.sh
timed "programs and tests (the first build takes minutes)" env NIGHTCITY_UNITY=ON pipelines/build.sh release
say "tests"
exec ctest --test-dir build/release --output-on-failure --parallel "$(nproc)" "$@"

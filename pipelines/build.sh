#!/usr/bin/env bash
# Configures and builds a preset: pipelines/build.sh [PRESET [TARGET...]]
# PRESET is release (the default), debug or asan; the programs are written to build/PRESET.
set -euo pipefail
# shellcheck source=pipelines/steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/steps.sh"

preset=${1:-release}
[ $# -eq 0 ] || shift
cd "$root"

options=("-DNIGHTCITY_UNITY=${NIGHTCITY_UNITY:-OFF}")  # CMakeLists.txt says what for
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  export CCACHE_SLOPPINESS=pch_defines,time_macros  # its manual's condition for precompiled headers
  # A service account may have no home folder for the cache.
  if [ ! -w "${HOME:-/nonexistent}" ]; then export CCACHE_DIR=${CCACHE_DIR:-$root/build/ccache}; fi
fi
# Ninja runs CMake again by itself when a CMakeLists.txt changes.
if [ ! -e "build/$preset/build.ninja" ]; then cmake --preset "$preset" "${options[@]}"; fi

# Compiling CGAL's templates takes about 1.5 GB of memory per job: run as many as fit, at most one per core.
memory_gb=$(awk '/^MemAvailable:/ { print int($2 / 1048576) }' /proc/meminfo)
jobs=$(nproc)
if [ $((memory_gb / 2)) -lt "$jobs" ]; then jobs=$((memory_gb / 2)); fi
if [ "$jobs" -lt 1 ]; then jobs=1; fi

export NINJA_STATUS='[%f/%t, %es] '
ninja -C "build/$preset" -j "$jobs" "$@"

#!/usr/bin/env bash
# Builds one commit twice, in folders of different names and lengths, without a compiler cache, and compares the bytes:
# tests/reproducible.sh [TARGET...]
# TARGET: programs or libraries of build/release (nightbake and nightview; they take as long as two first builds). Ends with 1
# where a file differs. REPRODUCIBLE_JOBS limits the compilers at once.
set -euo pipefail
# shellcheck source=../pipelines/steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/../pipelines/steps.sh"

targets=("$@")
[ $# -gt 0 ] || targets=(nightbake nightview)
cd "$root"
commit=$(git rev-parse HEAD)  # a first build takes long, and HEAD may move meanwhile
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

export CCACHE_DISABLE=1
folders=("$scratch/a" "$scratch/a-longer-name/with a blank")
for folder in "${folders[@]}"; do
  mkdir -p "$folder"
  git archive "$commit" | tar -x -C "$folder"
  (
    cd "$folder"
    cmake --preset release -DNIGHTCITY_TESTS=OFF >cmake.log
    ninja -C build/release ${REPRODUCIBLE_JOBS:+-j "$REPRODUCIBLE_JOBS"} "${targets[@]}" >ninja.log || {
      tail -20 ninja.log
      exit 1
    }
  )
done

# The files that the targets are linked from tell more than the programs: the first that differs is the cause.
same=0 failures=0
while IFS= read -r -d '' file; do
  if cmp -s "${folders[0]}/build/release/$file" "${folders[1]}/build/release/$file"; then
    same=$((same + 1))
  else
    echo "FAILED: $file differs"
    failures=$((failures + 1))
  fi
done < <(cd "${folders[0]}/build/release" && find . -type f \( -name '*.o' -o -name '*.a' -o -perm -u+x \) \
  -not -path '*/CMakeFiles/[0-9]*' -not -path '*/CompilerIdCXX/*' -not -path './CMakeFiles/CMakeScratch/*' -print0 | sort -z)
echo "$same files are the same, $failures differ"
[ "$same" -gt 0 ] && [ "$failures" -eq 0 ]

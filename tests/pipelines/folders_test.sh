#!/usr/bin/env bash
# The folders are as docs/architecture.md says: it names every library, and nothing includes what it must not.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit 1
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

while IFS= read -r list; do
  folder=$(dirname "${list#./}")
  grep -qF "| \`$folder/\` |" docs/architecture.md || fail "docs/architecture.md does not name $folder/"
done < <(grep -rlE '^(nightcity_library|add_executable|add_library)\(' --include=CMakeLists.txt formats tools runtime shaders)
while IFS= read -r folder; do
  [ -d "$folder" ] || fail "docs/architecture.md names $folder, which does not exist"
done < <(sed -nE 's,^[|] .([a-z_/]+/). [|].*,\1,p' docs/architecture.md)

# never WHAT FOLDERS... : no source below FOLDERS includes WHAT (an extended regular expression).
never() {
  local what=$1 found
  shift
  found=$(grep -rnE "^ *#include [\"<]($what)" --include='*.h' --include='*.cpp' --include='*.glsl' --include='*.comp' "$@")
  [ -z "$found" ] || fail "$* must not include $what: $found"
}
never 'tools/' formats runtime shaders
never 'runtime/' formats tools shaders
never 'shaders/' tools
never 'CGAL/|gdal|ogr|proj|osmium' formats runtime shaders
never 'vulkan/|GLFW/|imgui' formats tools
never 'tests/' formats runtime shaders tools
# A reader of the two files needs nothing of what the programs share.
while IFS= read -r file; do never 'formats/program/|CLI/|spdlog/' "$file"; done \
  < <(find formats -maxdepth 1 -name '*.h' -o -maxdepth 1 -name '*.cpp')
exit $((failures > 0))

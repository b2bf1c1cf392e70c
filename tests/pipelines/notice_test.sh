#!/usr/bin/env bash
# notice_test.sh PROGRAM...: the file NOTICE names every library that a built program is linked with.
set -uo pipefail
notice=$(dirname "${BASH_SOURCE[0]}")/../../NOTICE
failures=0

# The words by which NOTICE names a library, by the beginning of its file name.
declare -A words=(
  [libbz2]=bzip2 [libcitygml]=libcitygml [libcurl]=libcurl [libdraco]=Draco [libexpat]=expat [libfmt]=fmt [libgdal]=GDAL [libgeos_c]=GEOS
  [libGeographicLib]=GeographicLib [libglfw]=GLFW [libgmp]=GMP [libmpfr]=MPFR [libOpenEXR]=OpenEXR [libpng16]=libpng
  [libImath]=Imath [libproj]=PROJ [libpugixml]=pugixml [libsimdjson]=simdjson [libspdlog]=spdlog [libstb]=stb [libtbb]=oneTBB
  [libmimalloc]=mimalloc [libtomlplusplus]=toml++ [libvulkan]=Vulkan [libxerces]=Xerces-C [libxxhash]=xxHash [libz]=zlib [libzip]=libzip [libarchive]=libarchive
  [libimgui]="Dear ImGui" [libIlmThread]=OpenEXR [libIex]=OpenEXR
)
# The compiler's and the system's own.
own='^(libc|libm|libgcc_s|libstdc\+\+|libpthread|libdl|librt|ld-linux.*)$'

for program; do
  name=$(basename "$program")
  # Its paragraph: from its name, indented by two, to the next blank line.
  paragraph=$(awk -v name="$name" '/^$/ { inside = 0 } index($0, "  " name " ") == 1 { inside = 1 } inside' "$notice")
  if [[ -z $paragraph ]]; then
    echo "FAILED: NOTICE has no paragraph about $name"
    failures=$((failures + 1))
  fi
  while read -r library; do
    base=${library%%.so*}
    base=${base%%-[0-9]*}
    [[ $base =~ $own ]] && continue
    word=${words[$base]:-}
    if [[ -z $word ]]; then
      echo "FAILED: $name is linked with $library: name it in NOTICE, and its word in this test"
      failures=$((failures + 1))
    elif ! grep -qF -- "$word" <<<"$paragraph"; then
      echo "FAILED: $name is linked with $library, and NOTICE does not name $word there"
      failures=$((failures + 1))
    fi
  done < <(readelf --dynamic "$program" | sed -nE 's/.*\(NEEDED\).*\[(.*)\]/\1/p')
done
exit "$failures"

#!/usr/bin/env bash
# setup.sh changes nothing on a machine that has everything, and names the packages on one that it does not know.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit 1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

check() { # check WHAT CONDITION...
  if ! "${@:2}"; then
    echo "FAILED: $1"
    failures=$((failures + 1))
  fi
}

printf 'ID=fedora\nVERSION_ID="40"\n' >"$scratch/fedora"
NIGHTCITY_OS_RELEASE=$scratch/fedora pipelines/setup.sh >"$scratch/out" 2>"$scratch/err"
check "another distribution ends with 2" test $? -eq 2
check "the message names the distribution" grep -q 'fedora 40' "$scratch/err"
check "the message names a package of each section" \
  test "$(grep -cxE '  (g\+\+|libcgal-dev|libvulkan-dev|libgtest-dev)' "$scratch/err")" -eq 4
check "nothing goes to stdout" test ! -s "$scratch/out"

NIGHTCITY_OS_RELEASE=$scratch/missing pipelines/setup.sh >/dev/null 2>&1
check "a system without os-release ends with 2" test $? -eq 2
pipelines/setup.sh no-such-section >/dev/null 2>"$scratch/err"
check "an unknown section ends with 2" test $? -eq 2
check "the message names the section" grep -q 'no-such-section' "$scratch/err"

# Debian 12, with stubs in place of the programs that query and change the system: the test installs nothing.
printf 'ID=debian\nVERSION_ID="12"\n' >"$scratch/debian"
mkdir "$scratch/bin"
cat >"$scratch/bin/dpkg-query" <<'STUB'
#!/bin/sh
for name; do case $name in -* | cmake | libgtest-dev) ;; *) echo "ii  $name" ;; esac; done
case $ABSENT in no) printf 'ii  cmake\nii  libgtest-dev\n' ;; *) echo 'rc  cmake' ;; esac
STUB
cat >"$scratch/bin/apt-get" <<'STUB'
#!/bin/sh
echo "$*" >>"$CALLS"
STUB
printf '#!/bin/sh\nexec "$@"\n' >"$scratch/bin/sudo"
printf '#!/bin/sh\nexit 0\n' >"$scratch/bin/apt-cache"
chmod +x "$scratch"/bin/*
export CALLS=$scratch/calls NIGHTCITY_OS_RELEASE=$scratch/debian
touch "$CALLS"

ABSENT=no PATH=$scratch/bin:$PATH pipelines/setup.sh >"$scratch/out" 2>&1
check "a run with nothing missing ends with 0" test $? -eq 0
check "and calls no apt-get" test ! -s "$CALLS"

ABSENT=yes PATH=$scratch/bin:$PATH pipelines/setup.sh >"$scratch/out" 2>&1
check "a run with two missing packages ends with 0" test $? -eq 0
check "apt-get is called once, without an update" test "$(wc -l <"$CALLS")" -eq 1
check "with exactly the two, one of which was removed but not purged" \
  grep -q -- '--no-install-recommends cmake libgtest-dev$' "$CALLS"

printf '#!/bin/sh\nexit 100\n' >"$scratch/bin/apt-get"
ABSENT=yes PATH=$scratch/bin:$PATH pipelines/setup.sh >"$scratch/out" 2>&1
check "an installation that fails ends with 1" test $? -eq 1
check "and names what could not be installed" grep -q 'could not install: cmake libgtest-dev\|update failed' "$scratch/out"
exit "$failures"

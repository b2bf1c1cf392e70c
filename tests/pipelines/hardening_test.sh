#!/usr/bin/env bash
# hardening_test.sh PROGRAM...: built programs have what Debian's hardening gives, and load no library from the current folder.
set -uo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

check() { # check WHAT CONDITION...
  if ! "${@:2}"; then
    echo "FAILED: $1"
    failures=$((failures + 1))
  fi
}

has() { # has FILE PATTERN
  grep -qE "$2" "$1"
}

echo "not a library" >"$scratch/libz.so.1"
for program; do
  name=$(basename "$program")
  readelf --wide --file-header --dynamic --segments "$program" >"$scratch/elf"
  readelf --wide --dyn-syms "$program" >"$scratch/symbols"
  check "$name is position-independent" has "$scratch/elf" 'Type: +DYN'
  check "$name binds all symbols at its start" has "$scratch/elf" 'FLAGS_1.* NOW'
  check "$name has its relocations read-only" has "$scratch/elf" 'GNU_RELRO'
  check "$name has a stack that cannot be run" has "$scratch/elf" 'GNU_STACK .* RW '
  check "$name protects its stack" has "$scratch/symbols" '__stack_chk_fail'
  check "$name calls fortified functions" has "$scratch/symbols" '__(memcpy|snprintf|vsnprintf|read|pread|memmove|memset)[a-z0-9]*_chk'
  check "$name has no segment that is written and run" test "$(grep -cE 'LOAD .* (RWE|WE) ' "$scratch/elf")" -eq 0

  # An empty element (a colon too many) is the current folder; so is a relative one.
  path=$(sed -nE 's/.*\((RPATH|RUNPATH)\).*\[(.*)\]/\2/p' "$scratch/elf")
  if [[ -n $path ]]; then
    while read -r element; do
      check "$name searches for libraries beside itself alone, not in '$element'" test "${element#\$ORIGIN/}" != "$element"
    done < <(tr ':' '\n' <<<"$path")
  fi
  program=$(realpath "$program")
  (cd "$scratch" && "$program" --version) >"$scratch/out" 2>&1
  check "$name starts beside a foreign libz.so.1: $(head -c 300 "$scratch/out")" has "$scratch/out" "^$name [0-9]"
done
exit "$failures"

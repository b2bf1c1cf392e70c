# Functions for the scripts of this folder, which source this file.
# shellcheck shell=bash

# shellcheck disable=SC2034  # used by the script that sources this
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '\n== %s\n' "$*"; }

fail() { # fail CODE MESSAGE...
  local code=$1
  shift
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit "$code"
}

# timed NAME COMMAND...: runs the command, prints its name and time, and ends the script when it fails.
timed() {
  local name=$1 start=$SECONDS code=0
  shift
  say "$name"
  "$@" || code=$?
  if [ "$code" -ne 0 ]; then fail "$code" "\"$name\" failed after $((SECONDS - start)) s (exit code $code)"; fi
  printf '== %s: %d s\n' "$name" $((SECONDS - start))
}

# up_to_date OUTPUT INPUT...: true when OUTPUT exists and no input is newer.
up_to_date() {
  local output=$1 input
  shift
  [ -e "$output" ] || return 1
  for input in "$@"; do
    if [ "$input" -nt "$output" ]; then return 1; fi
  done
}

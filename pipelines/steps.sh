# Sourced by the scripts beside it: steps that say what they do and how long they took.
# shellcheck shell=bash

# shellcheck disable=SC2034  # for the script that sources this
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '\n== %s\n' "$*"; }

fail() { # fail CODE MESSAGE...
  local code=$1
  shift
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit "$code"
}

# timed NAME COMMAND...: announces, runs, and gives the time; ends the script where the command fails.
timed() {
  local name=$1 start=$SECONDS code=0
  shift
  say "$name"
  "$@" || code=$?
  if [ "$code" -ne 0 ]; then fail "$code" "\"$name\" failed after $((SECONDS - start)) s (exit code $code)"; fi
  printf '== %s: %d s\n' "$name" $((SECONDS - start))
}

# stands OUTPUT INPUT...: true where OUTPUT is there and no input is newer.
stands() {
  local output=$1 input
  shift
  [ -e "$output" ] || return 1
  for input in "$@"; do
    if [ "$input" -nt "$output" ]; then return 1; fi
  done
}

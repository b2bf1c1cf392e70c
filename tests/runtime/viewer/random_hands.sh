#!/usr/bin/env bash
# Drives the window with random keys, mouse and sizes: tests/runtime/viewer/random_hands.sh NIGHTVIEW SECONDS SCENE...
# NIGHTVIEW is the program, with sanitizers for instance. HANDS=switch only opens one SCENE after the other. SEED (1) chooses
# what is done. Prints the resident memory every half minute, in MB. Ends with 1 where the program ends by itself, reports an
# error of a sanitizer, or does not close within two minutes when it is asked to. Needs Xvfb and xdotool.
set -euo pipefail

if [ -z "${RANDOM_HANDS_INSIDE:-}" ]; then
  [ $# -ge 3 ] || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
  program=$(realpath "$1") seconds=$2
  shift 2
  export RANDOM_HANDS_INSIDE=$folder XDG_CONFIG_HOME=$folder/config
  xvfb-run -a -s '-screen 0 1000x800x24' "$0" "$program" "$seconds" "$@"
  exit
fi

program=$1 seconds=$2
shift 2
# Copies, because bookmarks and edits are written beside a scene.
scenes=()
for scene in "$@"; do
  copy=$RANDOM_HANDS_INSIDE/${#scenes[@]}
  mkdir "$copy"
  cp "$scene" "${scene%.glb}.lights" "$copy"
  scenes+=("$copy/$(basename "$scene")")
done
RANDOM=${SEED:-1}
cd "$RANDOM_HANDS_INSIDE"
events=0

# No Esc, which closes the window in the end, and no F11: without a window manager nothing takes it back.
keys=(w a s d q e f z b F2 F3 g r ctrl+c ctrl+v space 1 2 3 4 5 6 o comma period ctrl+e n m x v p ctrl+s Tab
      ctrl+plus ctrl+minus h Page_Down Return BackSpace 9)

start() {
  "$program" "${scenes[@]}" --size 480x320 >>out.txt 2>&1 &
  viewer=$!
  xdotool search --sync --onlyvisible --name nightview >window.txt
  window=$(head -1 window.txt)
}

fail() {
  echo "random_hands: $1, after $events events; the program's errors, or its last lines:" >&2
  grep -m1 -A60 -E "ERROR: AddressSanitizer|runtime error:|VUID-" out.txt >&2 || tail -25 out.txt >&2
  exit 1
}

do_something() {
  local x=$((RANDOM % 480)) y=$((RANDOM % 320))
  if [ "${HANDS:-all}" = switch ]; then
    xdotool key Page_Down
    sleep 2
    return
  fi
  case $((RANDOM % 10)) in
    0) xdotool mousemove "$x" "$y" click 1 ;;
    1) xdotool mousemove "$x" "$y" mousedown $((1 + 2 * (RANDOM % 2))) mousemove $((RANDOM % 480)) $((RANDOM % 320)) mouseup 1 mouseup 3 ;;
    2) xdotool mousemove "$x" "$y" click --repeat 3 $((4 + RANDOM % 2)) ;;
    3) xdotool windowsize "$window" $((100 + RANDOM % 700)) $((80 + RANDOM % 500)) ;;
    4) xdotool type --delay 5 "$RANDOM" ;;
    5) xdotool keydown "${keys[RANDOM % 6]}" sleep 0.2 keyup "${keys[RANDOM % 6]}" ;;
    *) xdotool key "${keys[RANDOM % ${#keys[@]}]}" ;;
  esac
}

start
for key in "${keys[@]:0:6}"; do xdotool keyup "$key"; done
began=$SECONDS told=-30
while [ $((SECONDS - began)) -lt "$seconds" ]; do
  kill -0 "$viewer" 2>/dev/null || fail "the program has ended by itself"
  do_something || true
  events=$((events + 1))
  if [ $((SECONDS - told)) -ge 30 ]; then
    told=$SECONDS
    echo "$((SECONDS - began)) s, $events events, $(awk '/^VmRSS/ { print int($2 / 1000) }' "/proc/$viewer/status") MB"
  fi
  sleep 0.05
done
for ((i = 0; i < 240; ++i)); do
  kill -0 "$viewer" 2>/dev/null || break
  xdotool key --window "$window" Escape 2>/dev/null || true
  sleep 0.5
done
! kill -0 "$viewer" 2>/dev/null || { kill -9 "$viewer"; fail "the program does not close"; }
wait "$viewer" || fail "the program's exit status is $?"
! grep -qE "ERROR: AddressSanitizer|runtime error:|VUID-" out.txt || fail "errors are reported"
echo "$events events in $seconds s, closed in order"

#!/usr/bin/env bash
# interruption_test.sh NIGHTBAKE [NIGHTVIEW]: kill -9, signals, full disks, and inputs and outputs that are no files.
set -uo pipefail
nightbake=$(realpath "$1")
nightview=${2:+$(realpath "$2")}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1
failures=0

check() { # check WHAT CONDITION...
  if ! "${@:2}"; then
    echo "FAILED: $1"
    failures=$((failures + 1))
  fi
}
same() { [[ $1 == "$2" ]]; }
has() { grep -q -- "$2" "$1"; } # has FILE TEXT
lists() { [[ $(ls -A "$1" 2>/dev/null | tr '\n' ' ') == "$2" ]]; } # lists FOLDER "NAMES "

"$nightbake" -q town --blocks 4 --out town >/dev/null || exit 1
"$nightbake" -q run town/town.toml --out whole >/dev/null || exit 1
city="bake_report.json city.glb city.lights "
check "a bake leaves three files" lists whole "$city"

# start_and_stop FOLDER: starts a bake of a larger town into FOLDER and stops it while it works in a hidden folder there,
# before it moves its files out: a signal that comes after that ends it with a whole city. Sets `child`.
"$nightbake" -q town --blocks 60 --out large >/dev/null || exit 1
start_and_stop() {
  local staging
  for _ in $(seq 20); do
    # Bash starts background jobs with INT ignored; env undoes that.
    env --default-signal "$nightbake" -q run large/town.toml --out "$1" >out 2>err &
    child=$!
    until compgen -G "$1/.nightbake-*" >/dev/null || ! kill -0 "$child" 2>/dev/null; do :; done
    kill -s STOP "$child" 2>/dev/null
    staging=$(compgen -G "$1/.nightbake-*") && [[ ! -e $staging/commit ]] && return 0
    kill -s CONT "$child" 2>/dev/null
    wait "$child"
    rm -rf made
  done
  return 1
}

# Signals that can be caught: nothing is left, not even the folders that the bake has made.
for signal in INT TERM HUP; do
  start_and_stop "made/by/$signal" || check "the bake was stopped at work ($signal)" false
  kill -s "$signal" "$child"
  kill -s CONT "$child"
  wait "$child"
  check "$signal ends the bake with 128 and its number" same $? $((128 + $(kill -l "$signal")))
  check "$signal leaves nothing: $(find made 2>/dev/null)" test ! -e made
done

# A town that is being written: nothing is left of it but whole files.
for signal in INT TERM HUP; do
  env --default-signal "$nightbake" -q town --blocks 4000 --out made/town >out 2>err &
  child=$!
  until [[ -e made/town ]] || ! kill -0 "$child" 2>/dev/null; do :; done
  kill -s "$signal" "$child"
  wait "$child"
  check "$signal ends town with 128 and its number" same $? $((128 + $(kill -l "$signal")))
  check "$signal leaves nothing of a town: $(find made 2>/dev/null)" test ! -e made
  rm -rf made
done

# The same into a folder with a city in it: the old one stays whole.
cp -r whole kept
start_and_stop kept || check "the bake was stopped at work" false
kill -s TERM "$child"
kill -s CONT "$child"
wait "$child"
check "TERM leaves the old city" lists kept "$city"
check "and all of it" diff -r whole kept

# kill -9, at ten moments: the old city or the new one, and the next bake removes what was left.
mkdir nine
for moment in 0 0.02 0.05 0.1 0.2 0.4 0.6 0.8 1 1.5; do
  "$nightbake" -q run town/town.toml --out nine >/dev/null 2>&1 &
  child=$!
  sleep "$moment"
  kill -9 "$child" 2>/dev/null
  wait "$child" 2>/dev/null
  if [[ -e nine/city.glb ]]; then
    check "after kill -9 at $moment s, a city.glb has its lights" cmp -s whole/city.lights nine/city.lights
    check "and is whole" cmp -s whole/city.glb nine/city.glb
  fi
done
"$nightbake" -q run town/town.toml --out nine >/dev/null || check "the next bake works" false
check "the next bake removes what kill -9 left" lists nine "$city"

# A full disk: stdout and files. /dev/full takes nothing; ulimit stops files at 100 kB.
for arguments in "--help" "--version" "inspect whole/city.glb" "inspect --json whole/city.lights" "run town/town.toml --out full"; do
  # shellcheck disable=SC2086
  "$nightbake" $arguments >/dev/full 2>err
  check "results of nightbake $arguments to a full disk are an error" same $? 1
  check "and it says so: $(cat err)" has err "standard output\|No space left\|cannot write"
done
rm -rf full
(ulimit -f 100 && "$nightbake" -q run town/town.toml --out full >/dev/null 2>err)
check "a bake to a full disk ends with 1" same $? 1
check "and says why: $(cat err)" has err "cannot be written: File too large"
check "and leaves nothing" test ! -e full
"$nightbake" -q layout town/town.toml --osm /dev/full >/dev/null 2>err
check "lamps to a full device are an error" same $? 1
check "/dev/full stays a device" test -c /dev/full

# Every other output, as files that may not grow beyond 1 kB, or 20 kB: nothing is left of it, nor of folders made for it.
"$nightbake" -q run town/town.toml --part 1/1 --out parts >/dev/null || exit 1
while read -r limit arguments; do
  # shellcheck disable=SC2086
  (ulimit -f "$limit" && "$nightbake" -q $arguments >/dev/null 2>err)
  check "nightbake $arguments to a full disk ends with 1" same $? 1
  check "and says why: $(cat err)" has err "cannot be written: "
  check "and leaves nothing: $(find full 2>/dev/null)" test ! -e full
  rm -rf full
done <<'END'
1 run town/town.toml --part 1/2 --out full
20 run town/town.toml --part 1/2 --out full/of/parts
20 merge parts/parts --out full
1 export whole -o full
20 export whole -o full/of/tiles
1 export whole -o full.gpkg
1 export whole -o full.fgb
1 lamps town/town.osm town/town.gml -o full.lights
1 lamps town/town.osm town/town.gml --lay-out -o full.osm
1 windows town/town.gml -o full.lights
1 traffic town/town.osm -o full.lights
1 elevate town/town.osm town/town.gml -o full.osm
20 price town/town.toml --no-pictures --only draco-1mm -o full
END
check "no file of them is left: $(compgen -G '*full.*')" same "$(compgen -G '*full.*')" ""

# A tileset and a part that a signal or a kill ends: nothing is left, or all where it came too late, and of a part its survey,
# which other parts take. The next one is whole.
"$nightbake" -q export whole --tile 10 -o tiles >/dev/null || exit 1
# is_whole FOLDER: with nothing beside it. Parts hold how long they took, so two of them differ.
is_whole() {
  if [[ -e $1/tileset.json ]]; then
    diff -r tiles "$1"
  else
    lists "$1" "parts " && lists "$1/parts" "part-1-of-1 survey " && rm -rf merged &&
      "$nightbake" -q merge "$1/parts" --out merged >/dev/null && cmp whole/city.glb merged/city.glb
  fi
}
for arguments in "export whole --tile 10" "run town/town.toml --part 1/1"; do
  for moment in 0.02 0.05 0.1 0.15 0.2; do
    for signal in TERM KILL; do
      # shellcheck disable=SC2086
      env --default-signal "$nightbake" -q $arguments --out made/of/it >out 2>err &
      child=$!
      sleep "$moment"
      kill -s "$signal" "$child" 2>/dev/null
      wait "$child" 2>/dev/null
      what="after $signal at $moment s of $arguments"
      if [[ $signal == TERM ]]; then
        check "$what no empty folder is left" same "$(find made -type d -empty 2>/dev/null)" ""
        [[ ! -e made || -e made/of/it/parts ]] || check "$what there is nothing or all" is_whole made/of/it
      fi
      # shellcheck disable=SC2086
      [[ -e made/of/it/tileset.json ]] || "$nightbake" -q $arguments --out made/of/it >/dev/null 2>err
      check "$what the next one is whole: $(cat err)" is_whole made/of/it
      rm -rf made
    done
  done
done

# Outputs that are no files, or lead to one.
"$nightbake" -q layout town/town.toml --osm /dev/null >/dev/null 2>err
code=$?
check "lamps to /dev/null succeed: $(cat err)" same $code 0
check "/dev/null stays a device" test -c /dev/null
mkfifo pipe.osm
timeout 60 cat pipe.osm >got &
timeout 60 "$nightbake" -q layout town/town.toml --osm pipe.osm >/dev/null 2>err
code=$?
check "lamps into a FIFO succeed: $(cat err)" same $code 0
wait $!
check "its reader gets them" has got "<osm"
check "it stays a FIFO" test -p pipe.osm
mkdir elsewhere linked
ln -s ../elsewhere/city.glb linked/city.glb
"$nightbake" -q run town/town.toml --out linked >/dev/null || check "a bake through a link works" false
check "a link stays" test -L linked/city.glb
check "and the scene is where it leads" cmp -s whole/city.glb elsewhere/city.glb

# Inputs that would be waited for.
mkfifo fifo.gml fifo.toml fifo.ies
for arguments in "inspect fifo.gml" "run fifo.toml --out no" "inspect fifo.ies" "inspect /dev/null"; do
  # shellcheck disable=SC2086
  timeout 20 "$nightbake" $arguments >out 2>err
  code=$?
  check "nightbake $arguments is refused at once: $(cat err)" same $code 1
done
TMPDIR=$scratch/absent "$nightbake" -q layout town/town.toml --osm lamps.osm >out 2>err
check "a missing TMPDIR is named: $(cat err)" has err "TMPDIR"

if [[ -n $nightview ]]; then
  for arguments in "--help" "--version"; do
    "$nightview" "$arguments" >/dev/full 2>err
    check "results of nightview $arguments to a full disk are an error" same $? 1
  done
  timeout 20 "$nightview" render fifo.gml --output a.png >out 2>err
  code=$?
  check "nightview refuses a FIFO at once: $(cat err)" same $code 1

  # A full disk: files of 1 or 4 kB at most. Pictures that went before stay, each of them whole.
  export LP_NUM_THREADS=0
  while read -r limit arguments; do
    # shellcheck disable=SC2086
    (ulimit -f "$limit" && "$nightview" -q $arguments >out 2>err)
    check "nightview $arguments to a full disk ends with 1" same $? 1
    check "and says why: $(cat err)" has err "cannot be written: "
    for picture in $(find full -name '*.exr' -o -name '*.png' 2>/dev/null); do
      "$nightview" compare "$picture" "$picture" >out 2>err
      check "and $picture is whole: $(cat err)" same $? 0
    done
    rm -rf full
  done <<'END'
1 render whole --size 32x18 --frames 1 -o full/a.png
4 render whole --size 32x18 --frames 1 -o full/a.exr
4 record whole --size 32x18 --path orbit --duration 0.08 --frames 1 --exr --out full
1 flight whole --size 32x18 --frames 2 --reference-frames 1 --pictures --out full
4 sweep whole --size 32x18 --frames 1 --estimator ris --candidates 1 --reference-frames 1 --warm-up 0 --views top --out full
4 upward whole --rays 4 --out full
1 strategies --lights 10 --size 32x18 --frames 1 --reference-frames 1 --out full
END
fi
exit "$failures"

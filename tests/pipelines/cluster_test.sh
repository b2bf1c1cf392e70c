#!/usr/bin/env bash
# cluster_test.sh NIGHTBAKE: Snakemake bakes a town in parts on two cores; a part that is killed is made again by the same
# command, and the result has the bytes of the whole bake. So do the scripts for SLURM and GNU parallel.
set -uo pipefail
nightbake=$(realpath "$1")
cluster=$(realpath "$(dirname "$0")/../../pipelines/cluster")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1
export HOME=$scratch # Snakemake and GNU parallel keep files there
failures=0

check() { # check WHAT CONDITION...
  if ! "${@:2}"; then
    echo "FAILED: $1"
    failures=$((failures + 1))
  fi
}
same_city() { cmp "$1/city.glb" whole/city.glb && cmp "$1/city.lights" whole/city.lights; }

"$nightbake" -q town --blocks 4 --out town >/dev/null || exit 1
"$nightbake" -q run town/town.toml --out whole >/dev/null || exit 1

# The scheduler's part of a SLURM array is played by a loop.
mkdir bin && ln -s "$nightbake" bin/nightbake
export PATH=$scratch/bin:$PATH
for task in 3 1 2; do
  SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_TASK_COUNT=3 SLURM_CPUS_PER_TASK=1 \
    bash "$cluster/parts.slurm" town/town.toml slurm >/dev/null || check "SLURM task $task" false
done
"$nightbake" -q merge slurm/parts --out slurm >/dev/null
check "a SLURM array gives the whole bake's bytes" same_city slurm

if command -v parallel >/dev/null; then
  "$cluster/parallel.sh" town/town.toml parallel 3 >/dev/null 2>err || cat err
  check "GNU parallel gives the whole bake's bytes" same_city parallel
else
  echo "not tried: GNU parallel is not installed"
fi

if ! command -v snakemake >/dev/null; then
  echo "skipped: snakemake is not installed (pipelines/setup.sh cluster)"
  [[ $failures -eq 0 ]] && exit 77
  exit 1
fi

# A nightbake that is killed at its third part, the first time.
cat >killed <<STUB
#!/bin/bash
echo "\$*" >>$scratch/calls
if [[ "\$*" == *"--part 3/4"* && ! -e $scratch/was_killed ]]; then
  touch $scratch/was_killed
  kill -9 \$\$
fi
exec $nightbake "\$@"
STUB
chmod +x killed
bake_in_parts() {
  snakemake -q -s "$cluster/Snakefile" --cores 2 --keep-going \
    --config recipe=town/town.toml out=snake parts=4 nightbake=./killed >log 2>&1
}
bake_in_parts && check "a killed part ends Snakemake with an error" false
check "the killed part is not there" test ! -e snake/parts/part-3-of-4
check "no city is there" test ! -e snake/city.glb
check "the others are done" test -e snake/parts/part-4-of-4
: >calls
bake_in_parts || { check "the same command resumes" false && cat log; }
check "only what was missing is made" test "$(grep -c -- --part calls)" -eq 1
check "Snakemake gives the whole bake's bytes" same_city snake
[[ $failures -eq 0 ]]

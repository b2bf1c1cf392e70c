#!/bin/sh
# Parts by GNU parallel, then the merge; the same again resumes: parallel.sh RECIPE OUT PARTS. On other machines that share
# the folder: PARALLEL="--sshlogin 8/node1,8/node2 --workdir ." parallel.sh RECIPE OUT PARTS
set -eu
seq "$3" | parallel --halt soon,fail=1 "${NIGHTBAKE:-nightbake}" -q run "$1" --part "{}/$3" --threads 1 --out "$2"
exec "${NIGHTBAKE:-nightbake}" -q merge "$2/parts" --recipe "$1" --out "$2"

#!/usr/bin/env bash
# Installs what nightcity needs on Debian 12: the packages of pipelines/packages.txt that are not there yet.
#
#   pipelines/setup.sh                 everything to build, run and test (sections build, tools, runtime, test)
#   pipelines/setup.sh SECTION...      only these sections of packages.txt
#
# Uses sudo where the user is not root. Exit codes: 0 all is there; 1 the installation failed; 2 this script does
# not know the distribution or may not install: it names the packages instead.
set -euo pipefail
# shellcheck source=pipelines/steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/steps.sh"

list=$root/pipelines/packages.txt
sections=("$@")
if [ $# -eq 0 ]; then sections=(build tools runtime test); fi
for section in "${sections[@]}"; do
  grep -qx "\[$section\]" "$list" || fail 2 "packages.txt has no section [$section]"
done

# One package a line under [section]; # begins a comment.
mapfile -t packages < <(awk -v wanted="${sections[*]}" '
  BEGIN { count = split(wanted, names, " "); for (i = 1; i <= count; ++i) ask[names[i]] = 1 }
  { sub(/#.*/, "") }
  /^\[.*\]/ { section = substr($1, 2, length($1) - 2); next }
  NF && (section in ask) { print $1 }' "$list" | sort -u)

# NIGHTCITY_OS_RELEASE: another file to read the distribution from, for the test of this script.
os_release=${NIGHTCITY_OS_RELEASE:-/etc/os-release}
# shellcheck source=/dev/null
distribution=$( (. "$os_release" && echo "${ID:-unknown} ${VERSION_ID:-}") 2>/dev/null || echo unknown)
if [ "$distribution" != "debian 12" ]; then
  {
    echo "setup.sh: this script knows Debian 12; this is \"$distribution\"."
    echo "Please install what these Debian packages hold, by your system's own names, then run cmake yourself"
    echo "(cmake --preset release && cmake --build --preset release):"
    printf '  %s\n' "${packages[@]}"
  } >&2
  exit 2
fi

# dpkg-query fails where a name is unknown to it and still lists the others: its output decides.
installed=$(dpkg-query -W -f='${db:Status-Abbrev} ${Package}\n' "${packages[@]}" 2>/dev/null | awk '/^.i/ { print $2 }' || true)
mapfile -t missing < <(comm -23 <(printf '%s\n' "${packages[@]}") <(sort -u <<<"$installed"))
if [ ${#missing[@]} -eq 0 ]; then
  echo "setup.sh: all ${#packages[@]} packages are there"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || fail 2 "neither root nor sudo: please have these packages installed: ${missing[*]}"
  as_root=(sudo)
fi

echo "setup.sh: installing ${#missing[@]} of ${#packages[@]} packages: ${missing[*]}"
apt() {
  # Another apt on the machine (unattended upgrades) is waited for; nothing is asked.
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 -q "$@"
}
known() {
  local package
  for package in "${missing[@]}"; do
    apt-cache show --no-all-versions "$package" >/dev/null 2>&1 || return 1
  done
}
install() { apt install -y --no-install-recommends "${missing[@]}"; }

# The package lists may be absent (a fresh image) or name versions that the mirror no longer has.
known || apt update || fail 1 "apt-get update failed: is Debian's mirror reachable?"
install || { apt update && install; } || fail 1 "apt-get could not install: ${missing[*]}"

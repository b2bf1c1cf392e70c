#!/usr/bin/env bash
# Installs what nightcity needs on Debian 12: the packages of pipelines/packages.txt that are missing.
#
#   pipelines/setup.sh                 everything to build, run and test (sections build, tools, runtime, test)
#   pipelines/setup.sh SECTION...      only these sections of packages.txt
#
# Uses sudo when the user is not root. Exit codes: 0 all packages are installed; 1 the installation failed; 2 this
# script does not know the distribution, or may not install: it names the packages instead.
set -euo pipefail
# shellcheck source=pipelines/steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/steps.sh"

list=$root/pipelines/packages.txt
sections=("$@")
if [ $# -eq 0 ]; then sections=(build tools runtime test); fi
for section in "${sections[@]}"; do
  grep -qx "\[$section\]" "$list" || fail 2 "packages.txt has no section [$section]"
done

# The list has one package per line below [section]; # begins a comment.
mapfile -t packages < <(awk -v wanted="${sections[*]}" '
  BEGIN { count = split(wanted, names, " "); for (i = 1; i <= count; ++i) ask[names[i]] = 1 }
  { sub(/#.*/, "") }
  /^\[.*\]/ { section = substr($1, 2, length($1) - 2); next }
  NF && (section in ask) { print $1 }' "$list" | sort -u)

# The test of this script names another file in NIGHTCITY_OS_RELEASE.
os_release=${NIGHTCITY_OS_RELEASE:-/etc/os-release}
# shellcheck source=/dev/null
distribution=$( (. "$os_release" && echo "${ID:-unknown} ${VERSION_ID:-}") 2>/dev/null || echo unknown)
if [ "$distribution" != "debian 12" ]; then
  {
    echo "setup.sh: this script supports Debian 12; this is \"$distribution\"."
    echo "Please install the equivalents of these Debian packages, then build with"
    echo "cmake --preset release && cmake --build --preset release:"
    printf '  %s\n' "${packages[@]}"
  } >&2
  exit 2
fi

# dpkg-query fails when it does not know a name, and still lists the others; so only its output counts.
installed=$(dpkg-query -W -f='${db:Status-Abbrev} ${Package}\n' "${packages[@]}" 2>/dev/null | awk '/^.i/ { print $2 }' || true)
mapfile -t missing < <(comm -23 <(printf '%s\n' "${packages[@]}") <(sort -u <<<"$installed"))
if [ ${#missing[@]} -eq 0 ]; then
  echo "setup.sh: all ${#packages[@]} packages are installed"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || fail 2 "needs root or sudo to install these packages: ${missing[*]}"
  as_root=(sudo)
fi

echo "setup.sh: installing ${#missing[@]} of ${#packages[@]} packages: ${missing[*]}"
apt() {
  # Wait for another apt on the machine (unattended upgrades), and ask no questions.
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 -q "$@"
}
known() {
  local package
  for package in "${missing[@]}"; do
    apt-cache show --no-all-versions "$package" >/dev/null 2>&1 || return 1
  done
}
install() { apt install -y --no-install-recommends "${missing[@]}"; }

# The package lists may be missing (a fresh image) or name versions that the mirror no longer has.
known || apt update || fail 1 "apt-get update failed: is Debian's mirror reachable?"
install || { apt update && install; } || fail 1 "apt-get could not install: ${missing[*]}"

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs those packages of viewer/packages.txt that are missing, of the sections named (build, test). Nothing
# missing: says nothing and needs no rights. Without root or sudo it prints the command to run and fails.
# SIDELIGHT_NO_INSTALL=1 skips it, for systems other than Debian.
set -euo pipefail

list="$(dirname -- "${BASH_SOURCE[0]}")/packages.txt"
[[ -z ${SIDELIGHT_NO_INSTALL:-} ]] || exit 0

missing=()
for section in "$@"; do
  while read -r package; do
    status="$(dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null)" || true
    grep -qx installed <<<"$status" || missing+=("$package")
  done < <(sed -nE "s/^$section: *([^ #]+).*/\1/p" "$list")
done
((${#missing[@]})) || exit 0

# Another apt may be at work on a fresh machine: wait for its lock.
options=(-qq -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0)
install=(apt-get install -y --no-install-recommends "${missing[@]}")

fail() {
  echo "error: $1. Run this, then try again:" >&2
  echo "  sudo apt-get update && sudo ${install[*]}" >&2
  exit 1
}

command -v apt-get >/dev/null || fail "packages are missing and this is no Debian"
as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || fail "packages are missing, and installing them needs root"
  as_root=(sudo)
  sudo env true || fail "packages are missing, and sudo refuses"   # once, not at each step below
fi

echo "installing ${#missing[@]} Debian packages: ${missing[*]}" >&2
for attempt in first second; do
  "${as_root[@]}" apt-get "${options[@]}" update >&2 || echo "warning: apt-get update failed, going on" >&2
  if "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive "${install[@]}" "${options[@]}" >/dev/null; then
    exit 0
  fi
  echo "the $attempt attempt failed" >&2
done
fail "the packages could not be installed"

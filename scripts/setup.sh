#!/usr/bin/env bash
# Installs the packages of packages.txt that this machine lacks (Debian 12, as root).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export DEBIAN_FRONTEND=noninteractive

# A node of at least Debian's version together with npm replaces Debian's own two packages, which cannot live beside it.
have_node() {
  command -v npm >/dev/null && command -v node >/dev/null && [ "$(node -p 'parseInt(process.versions.node)')" -ge 18 ]
}

missing=()
while read -r package _; do
  case "$package" in
    '' | '#'*) continue ;;
    nodejs | npm) have_node && continue ;;
  esac
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done <packages.txt

if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: all packages of packages.txt are installed"
  exit 0
fi
if [ "$(id -u)" -ne 0 ]; then
  echo "setup: missing packages; run as root:" >&2
  echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
  exit 1
fi

echo "setup: installing ${missing[*]}"
install() {
  apt-get install --yes --quiet --no-install-recommends -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=300 "$@" "${missing[@]}"
}
# The package lists are fetched only when they are absent or too old to install from.
if ! install --simulate >/dev/null 2>&1 || ! install; then
  apt-get update --quiet
  install
fi

#!/usr/bin/env bash
# Installs the packages of packages.txt that this machine lacks (Debian 12, as root).
# usage: setup.sh [run] [page] [test] [docs]: these groups of it; without an argument, all.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export DEBIAN_FRONTEND=noninteractive

wanted=" ${*:-run page test docs} "
for group in $wanted; do
  grep --quiet "^# Group $group:" packages.txt || { echo "setup: packages.txt has no group $group" >&2; exit 2; }
done

# A node of at least Debian's version together with npm replaces Debian's own two packages, which cannot live beside it.
have_node() {
  command -v npm >/dev/null && command -v node >/dev/null && [ "$(node -p 'parseInt(process.versions.node)')" -ge 18 ]
}

missing=() group=
while read -r package rest; do
  case "$package $rest" in
    '# Group '*) group=${rest#Group } group=${group%%:*} ;;
  esac
  case "$package" in
    '' | '#'*) continue ;;
    nodejs | npm) have_node && continue ;;
  esac
  [[ $wanted == *" $group "* ]] || continue
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done <packages.txt

if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: all packages are installed (packages.txt:$wanted)"
  exit 0
fi
if [ "$(id -u)" -ne 0 ]; then
  echo "setup: missing packages; run as root:" >&2
  echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
  exit 1
fi

echo "setup: installing ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT

# apt's messages go to a log that is shown if it fails; its progress, a line for each tenth.
install() {
  apt-get install --yes --quiet --no-install-recommends -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=300 "$@" "${missing[@]}"
}
with_progress() {
  { "$@" -o APT::Status-Fd=3 3>&1 >"$log" 2>&1 || { cat "$log" >&2; false; }; } | awk -F: '
    $1 == "dlstatus" { stage = "downloading" } $1 == "pmstatus" { stage = "installing" }
    { part = 10 * int($3 / 10) } NF > 3 && stage " " part != last {
      last = stage " " part; printf "setup: %s %d %%\n", stage, part; fflush() }'
}
# The package lists are fetched only when they are absent or too old to install from.
if ! install --simulate >/dev/null 2>&1 || ! with_progress install; then
  apt-get update --quiet
  with_progress install
fi

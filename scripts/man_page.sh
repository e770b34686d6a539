#!/usr/bin/env bash
# Prints the man page, made from the program's own help.
# usage: man_page.sh PROGRAM
set -euo pipefail
program=$1

sections=$(mktemp)
trap 'rm -f "$sections"' EXIT
commands=$("$program" --help | awk '/^Subcommands:/ { found = 1; next } found && /^  [a-z]/ { print $1 }')
[ -n "$commands" ] || { echo "man_page: no subcommands in the help" >&2; exit 1; }
{
  for command in $commands; do
    printf '[KOSHI %s]\n.nf\n' "${command^^}"
    "$program" "$command" --help | sed -e 's/\\/\\e/g' -e 's/^\([.'"'"']\)/\\\&\1/' -e 's/-/\\-/g'
    printf '.fi\n\n'
  done
  printf '[EXIT STATUS]\n0 done, 1 the run failed, 2 bad input or arguments.\n'
} >"$sections"
help2man --no-info --name="lattice spring engine for elastic solids" --include="$sections" "$program"

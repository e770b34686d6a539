#!/usr/bin/env bash
# Makes the README's pictures of the paper's Figs. 6 and 7 from the page of `koshi paper`.
# usage: paper_pictures.sh [PAPER_DIRECTORY] [PICTURE_DIRECTORY]   (out/paper, docs/images)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
page=$(realpath "${1:-out/paper}/report.html")
pictures=$(realpath -m "${2:-docs/images}")

mkdir -p "$pictures"
cd report
[ -d node_modules ] || npm ci --loglevel=error
# Fig. 6 for Cube-II, the second of the three lattices; Fig. 7 is the first plot.
node scripts/screenshot.mjs "$page" "$pictures/paper_fig6.png" --only '#figures figure:nth-of-type(2)' --width 1000 --scale 1.5 --margin 10
node scripts/screenshot.mjs "$page" "$pictures/paper_fig7.png" --only '#figures figure:nth-of-type(4)' --width 760 --scale 1.5 --margin 10

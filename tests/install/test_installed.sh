#!/usr/bin/env bash
# Uses what is installed under a prefix, and nothing of the build: program, man page, completion, report page, Python
# module.
# usage: test_installed.sh PREFIX WORK_DIRECTORY CASE PYTHON|"" REPORT(ON|OFF)
set -euo pipefail
root=$1 work=$2 case=$3 python=$4 report=$5

modules=lib/python3/dist-packages
files="bin/koshi lib/libkoshi.a include/koshi/error.h lib/cmake/koshi/koshiConfig.cmake share/doc/koshi/copyright
  share/doc/koshi/examples/README.md share/doc/koshi/examples/05_torsion_bar/case.toml
  share/man/man1/koshi.1.gz share/bash-completion/completions/koshi"
[ -z "$python" ] || files+=" $modules/koshi/__init__.py $modules/koshi/_koshi.pyi $modules/koshi/py.typed"
[ "$report" != ON ] || files+=" share/koshi/report.html"
for file in $files; do
  [ -f "$root/$file" ] || { echo "$root lacks $file"; exit 1; }
done
# The program runs from where it lies, and finds its page there.
mkdir -p "$work"
cd "$work"
rm -rf out python
export PATH=$root/bin:$PATH
unset KOSHI_REPORT_TEMPLATE
[ "$(koshi --version)" = "koshi 0.1.0" ] || { echo "wrong version"; exit 1; }
koshi calibrate --help | grep -q -- --poissons-ratio || { echo "no help of calibrate"; exit 1; }
page=false
[ "$report" != ON ] || page=true
koshi run "$case" --out out --quiet --set output.report=$page
grep -q '"converged": true' out/summary.json || { echo "no result"; exit 1; }
check_page() { [ "$report" != ON ] || grep -q 'id="koshi-data">{"format":"koshi-report/1"' "$1"; }
check_page out/report.html || { echo "no report"; exit 1; }

# The module runs the same case to the same numbers.
if [ -n "$python" ]; then
  PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$root/$modules "$python" - "$case" "$root" $page <<'END'
import json, sys
import koshi, koshi.plot
assert koshi.__file__.startswith(sys.argv[2]), koshi.__file__
result = koshi.run(sys.argv[1], out="python", overrides=["output.report=" + sys.argv[3]])
probes = json.load(open("out/summary.json"))["probes"]
assert probes, "no probes"
for name, value in probes.items():
    assert (result.measurement.probes[name] == list(value.values())[0]).all(), name
END
  check_page python/report.html || { echo "no report from Python"; exit 1; }
fi

# The man page has every subcommand, and reads without complaint where man is there.
subcommands=$(koshi --help | awk '/^Subcommands:/ { found = 1; next } found && /^  [a-z]/ { print $1 }')
[ "$(wc -w <<<"$subcommands")" -ge 5 ] || { echo "subcommands: $subcommands"; exit 1; }
for command in $subcommands; do
  zcat "$root/share/man/man1/koshi.1.gz" | grep -q "SH \"KOSHI ${command^^}\"" || { echo "man page lacks $command"; exit 1; }
done
if command -v man >/dev/null; then
  warnings=$(LC_ALL=C.UTF-8 MANWIDTH=200 man --warnings -l "$root/share/man/man1/koshi.1.gz" 2>&1 >/dev/null)
  [ -z "$warnings" ] || { echo "man page: $warnings"; exit 1; }
fi

# Completion offers the subcommands that begin with "cal" and the options of one.
bash -c '
  set -eu
  . "$1"
  COMP_WORDS=(koshi cal) COMP_CWORD=1; _koshi; [ "${COMPREPLY[*]}" = calibrate ]
  COMP_WORDS=(koshi calibrate --poi) COMP_CWORD=2; _koshi; [ "${COMPREPLY[*]}" = --poissons-ratio ]
' _ "$root/share/bash-completion/completions/koshi" || { echo "completion does not work"; exit 1; }
echo "program, page and module run from $root"

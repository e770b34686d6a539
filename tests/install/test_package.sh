#!/usr/bin/env bash
# Builds the Debian package, unpacks it under a temporary prefix and runs the program from there.
# usage: test_package.sh BUILD_DIRECTORY WORK_DIRECTORY
set -euo pipefail
build=$1 work=$2

rm -rf "$work"
mkdir -p "$work/root"
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$work" >"$work/cpack.log" 2>&1 || { cat "$work/cpack.log"; exit 1; }
package=$work/koshi_0.1.0_amd64.deb
dpkg --info "$package"

dpkg -x "$package" "$work/root"
for file in usr/bin/koshi usr/lib/libkoshi.a usr/include/koshi/error.h usr/lib/cmake/koshi/koshiConfig.cmake \
  usr/share/man/man1/koshi.1.gz usr/share/bash-completion/completions/koshi; do
  [ -f "$work/root/$file" ] || { echo "package lacks $file"; exit 1; }
done

# Every library the program names comes from a package that is declared.
depends=$(dpkg-deb --field "$package" Depends)
declared() { [[ ", $depends," == *", $1,"* || ", $depends," == *", $1 ("* ]]; }
count=0
for library in $(objdump -p "$work/root/usr/bin/koshi" | awk '$1 == "NEEDED" { print $2 }'); do
  file=$(ldd "$work/root/usr/bin/koshi" | awk -v name="$library" '$1 == name { print $3 }')
  real=/usr/$(realpath "$file" | sed 's#^\(/usr\)\?/##')
  owner=$(dpkg -S "$real" 2>/dev/null || dpkg -S "${real#/usr}")
  declared "${owner%%:*}" || { echo "$library: package does not depend on ${owner%%:*} ($depends)"; exit 1; }
  count=$((count + 1))
done
[ $count -ge 10 ] || { echo "only $count libraries found in the program"; exit 1; }
declared openmpi-bin || { echo "package does not depend on mpiexec ($depends)"; exit 1; }

# The program runs from where it was unpacked.
[ "$("$work/root/usr/bin/koshi" --version)" = "koshi 0.1.0" ] || { echo "wrong version"; exit 1; }
"$work/root/usr/bin/koshi" calibrate --help | grep -q -- --poissons-ratio || { echo "no help of calibrate"; exit 1; }
zcat "$work/root/usr/share/man/man1/koshi.1.gz" | grep -q 'SH "KOSHI CALIBRATE"' || { echo "man page lacks calibrate"; exit 1; }

# Completion offers the subcommands that begin with "cal" and the options of one.
PATH=$work/root/usr/bin:$PATH bash -c '
  set -eu
  . "$1"
  COMP_WORDS=(koshi cal) COMP_CWORD=1; _koshi; [ "${COMPREPLY[*]}" = calibrate ]
  COMP_WORDS=(koshi calibrate --poi) COMP_CWORD=2; _koshi; [ "${COMPREPLY[*]}" = --poissons-ratio ]
' _ "$work/root/usr/share/bash-completion/completions/koshi" || { echo "completion does not work"; exit 1; }
echo "$count libraries, all declared"

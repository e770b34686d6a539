#!/usr/bin/env bash
# Builds the Debian package, checks what it declares, unpacks it under a temporary root and uses what lies there.
# usage: test_package.sh BUILD_DIRECTORY WORK_DIRECTORY CASE PYTHON|"" REPORT(ON|OFF)
set -euo pipefail
build=$1 work=$2 case=$3 python=$4 report=$5

rm -rf "$work"
mkdir -p "$work/root"
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$work" >"$work/cpack.log" 2>&1 || { cat "$work/cpack.log"; exit 1; }
package=$(ls "$work"/koshi_0.1.0_*.deb)
dpkg --info "$package"

dpkg -x "$package" "$work/root"
root=$work/root/usr
modules=lib/python3/dist-packages
outside=$(dpkg -c "$package" | awk '{ print $6 }' | grep -vE '^\./(usr/.*)?$' || true)
[ -z "$outside" ] || { echo "outside of /usr: $outside"; exit 1; }

# Every library the program and the module name comes from a package that is declared, and none is looked for in the
# build tree.
depends=$(dpkg-deb --field "$package" Depends)
declared() { [[ ", $depends," == *", $1,"* || ", $depends," == *", $1 ("* ]]; }
count=0
binaries=("$root/bin/koshi")
[ -z "$python" ] || binaries+=("$root/$modules"/koshi/_koshi*.so)
for binary in "${binaries[@]}"; do
  if objdump -p "$binary" | grep -E 'RPATH|RUNPATH'; then echo "$binary looks for libraries there"; exit 1; fi
  for library in $(objdump -p "$binary" | awk '$1 == "NEEDED" { print $2 }'); do
    file=$(ldd "$binary" | awk -v name="$library" '$1 == name { print $3 }')
    real=/usr/$(realpath "$file" | sed 's#^\(/usr\)\?/##')
    owner=$(dpkg -S "$real" 2>/dev/null || dpkg -S "${real#/usr}")
    declared "${owner%%:*}" || { echo "$library: package does not depend on ${owner%%:*} ($depends)"; exit 1; }
    count=$((count + 1))
  done
done
[ $count -ge 10 ] || { echo "only $count libraries found in the program"; exit 1; }
declared openmpi-bin || { echo "package does not depend on mpiexec ($depends)"; exit 1; }

echo "$count libraries, all declared"

"$(dirname "${BASH_SOURCE[0]}")/test_installed.sh" "$root" "$work" "$case" "$python" "$report"

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
for file in usr/bin/koshi usr/lib/libkoshi.a usr/include/koshi/error.h usr/lib/cmake/koshi/koshiConfig.cmake; do
  [ -f "$work/root/$file" ] || { echo "package lacks $file"; exit 1; }
done

# Every library the program names comes from a package that is declared.
depends=$(dpkg-deb --field "$package" Depends)
declared() { [[ ", $depends," =~ ,\ $1[\ ,] ]]; }
count=0
for library in $(objdump -p "$work/root/usr/bin/koshi" | awk '$1 == "NEEDED" { print $2 }'); do
  file=$(ldd "$work/root/usr/bin/koshi" | awk -v name="$library" '$1 == name { print $3 }')
  real=/usr/$(realpath "$file" | sed 's#^\(/usr\)\?/##')
  owner=$(dpkg -S "$real" 2>/dev/null || dpkg -S "${real#/usr}")
  declared "${owner%%:*}" || { echo "$library: package does not depend on ${owner%%:*} ($depends)"; exit 1; }
  count=$((count + 1))
done
[ $count -ge 1 ] || { echo "no libraries found in the program"; exit 1; }
declared openmpi-bin || { echo "package does not depend on mpiexec ($depends)"; exit 1; }
echo "$count libraries, all declared"

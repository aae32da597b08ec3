#!/usr/bin/env bash
# Makes the Debian package, unpacks it elsewhere and uses it from there: package_test.sh BUILD-FOLDER
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "FAILED: $*"; exit 1; }

(cd "$folder" && cpack --config "$1/CPackConfig.cmake" -B "$folder/made" >log 2>&1) ||
  { cat "$folder/log"; fail "cpack"; }
package=("$folder"/made/touchstone_*.deb)
dpkg-deb -c "${package[0]}" | awk '{print $6}' >"$folder/files"
for file in bin/touchstone lib/touchstone/touchstone-{host,reference.so} include/touchstone/candidate.h \
  include/touchstone/touchstone.hpp include/touchstone/engines/{bullet,mujoco,ode}.hpp \
  include/touchstone/touchstone_contacts.h \
  lib/libtouchstone_reference.a \
  lib/cmake/touchstone/touchstoneConfig.cmake share/man/man1/touchstone.1 \
  share/bash-completion/completions/touchstone share/zsh/vendor-completions/_touchstone \
  share/doc/touchstone/copyright share/touchstone/check_certificate.py \
  share/touchstone/scenes/wheel-on-road.json share/touchstone/suite/touchstone-suite-1.csv.gz \
  share/touchstone/suite/touchstone_suite.hpp; do
  grep -qx "./usr/$file" "$folder/files" || fail "the package lacks $file"
done
for plugin in "$1"/candidates/touchstone-*.so; do
  grep -qx "./usr/lib/touchstone/${plugin##*/}" "$folder/files" || fail "the package lacks ${plugin##*/}"
done
! grep -E '_test|sabotage|\.o$' "$folder/files" || fail "the package holds what is ours alone"
depends=$(dpkg-deb -f "${package[0]}" Depends)
for library in libc6 libgmp10 libmpfr6 libflint; do
  [[ $depends == *$library* ]] || fail "the package does not depend on $library: $depends"
done

dpkg-deb -x "${package[0]}" "$folder/root"
cd /
prefix=$folder/root/usr
touchstone=$prefix/bin/touchstone
[ "$("$touchstone" list candidates | grep -c '^[a-z]')" = "$("$1/touchstone" list candidates | grep -c '^[a-z]')" ] ||
  fail "the unpacked program finds other candidates"
(cd "$folder" && "$touchstone" report --pair cylinder-plane --count 1 --only scores >table 2>messages) ||
  { cat "$folder/messages"; fail "report"; }
[ -s "$folder/out/report.html" ] || fail "no report.html"
"$touchstone" replay --certify cylinder-box/rim-face/1/0 >"$folder/proof.json"
python3 "$prefix/share/touchstone/check_certificate.py" "$folder/proof.json" >/dev/null

# What it prints can be run there, and the pages that it names can be read, with those they link to.
! grep -qF ./touchstone "$folder/table" "$folder/out/report.html" || fail "there is no ./touchstone to run"
pages=$prefix/share/doc/touchstone
for page in $(grep -rahoE '\b(docs|candidates|oracle|suite|reference)/[a-zA-Z/-]+\.md' "$prefix"/{bin,lib,share/man,include} | sort -u); do
  [ -s "$pages/$page" ] || fail "$page is named and not installed"
done
[ -s "$pages/docs/check.md" ] || fail "no pages are installed"
while read -r page; do
  for link in $(grep -oE '\]\([^)#: ]+\.md' "$page" | cut -c 3-); do
    [ -s "$(dirname "$page")/$link" ] || fail "$page links to $link, which is not installed"
  done
done < <(find "$pages" -name '*.md')

# The library is the one that reference/CMakeLists.txt builds examples with.
cmake --install "$1/reference" --prefix "$folder/installed" --component touchstone_reference >/dev/null
[ -s "$folder/installed/lib/libtouchstone_reference.a" ] || fail "no library is installed"
while read -r file; do
  cmp "$folder/installed/$file" "$prefix/$file" || fail "the package's library: $file is another one"
done < <(cd "$folder/installed" && find . -type f)

# The Python module, where it is built: it finds the plug-ins of the program beside it.
[ -e "$1"/python/touchstone/__init__.py ] || exit 0
cat >"$folder/components.cmake" <<'CODE'
include(${CONFIG})
include(${CPACK_PROJECT_CONFIG_FILE})
message(${CPACK_COMPONENTS_ALL})
set(CPACK_PYTHON_MODULE nowhere)
include(${CPACK_PROJECT_CONFIG_FILE})
message(${CPACK_COMPONENTS_ALL})
CODE
components=$(cmake -D CONFIG="$1/CPackConfig.cmake" -P "$folder/components.cmake" 2>&1)
[ "$(grep -c touchstone_reference <<<"$components") $(grep -c touchstone_python <<<"$components")" = "2 1" ] ||
  fail "without the module: $components"
module=("$folder"/made/python3-touchstone_*.deb)
! grep -q dist-packages "$folder/files" || fail "the program's package holds the module"
dpkg-deb -x "${module[0]}" "$folder/root"
[[ $(dpkg-deb -f "${module[0]}" Depends) == *python3-numpy*"touchstone (= "*libc6* ]] ||
  fail "the module's package depends on $(dpkg-deb -f "${module[0]}" Depends)"
PYTHONPATH=$prefix/lib/python3/dist-packages /usr/bin/python3 - <<'CODE' || fail "the module"
import touchstone
assert "/root/" in touchstone.__file__, touchstone.__file__
report = touchstone.report(touchstone.contact, pairs=["cylinder-plane"], classes=["lying"], count=1)
assert [c["name"] for c in report.to_dict()["candidates"]] == ["reference", "function"]
CODE

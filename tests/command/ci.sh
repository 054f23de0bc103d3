#!/usr/bin/env bash
# The scripts in .ci name programs and tests that there are, and make wheels that Python reads.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

eval "$(grep -oE '(tests|programs)=\([a-z][a-z_ ]*\)' "$source_folder/.ci/arm64")"
# shellcheck disable=SC2154  # both are set above
((${#tests[@]} > 5 && ${#programs[@]} > 3)) || fault ".ci/arm64 lists no tests and programs where they are looked for"
listed=$(ctest --test-dir "$build_folder" -N)
for test in "${tests[@]}"; do
    grep -qE ": $test\$" <<<"$listed" || fault ".ci/arm64 runs the test '$test', which is not there"
done
built=$(cmake --build "$build_folder" --target help)
for program in "${programs[@]}"; do
    grep -qE "^$program: " <<<"$built" || fault ".ci/arm64 builds '$program', which is not there"
done

# A wheel of a program that prints what it is given.
mkdir -p tree/bin
printf '#!/bin/sh\necho "given $*"\n' >tree/bin/strahl
chmod +x tree/bin/strahl
"$source_folder/.ci/wheel" tree 1.2.3 any || fault ".ci/wheel failed"
mkdir installed
(cd installed && cmake -E tar xf ../strahl-1.2.3-py3-none-any.whl)
while IFS=, read -r path sum size; do
    [[ -f installed/$path ]] || fault "the list of the wheel names $path, which is not in it"
    [[ -z $sum || $(stat -c %s "installed/$path") == "$size" ]] || fault "the list has a wrong size of $path"
done <installed/strahl-1.2.3.dist-info/RECORD
[[ $(wc -l <installed/strahl-1.2.3.dist-info/RECORD) == $(find installed -type f | wc -l) ]] ||
    fault "the list of the wheel is not whole"
listed=$(sed -n 's/^strahl\/bin\/strahl,sha256=\(.*\),.*/\1=/p' installed/strahl-1.2.3.dist-info/RECORD)
listed=$(basenc -d --base64url <<<"$listed" | od -An -v -tx1 | tr -d ' \n')
[[ $listed == "$(sha256sum <tree/bin/strahl | cut -d ' ' -f 1)" ]] || fault "the list has a wrong sum: $listed"
if command -v python3 >/dev/null; then
    [[ $(PYTHONPATH=installed python3 -m strahl a 'b c') == "given a b c" ]] || fault "python -m strahl does not start it"
else
    left_out "python3 is not installed"
fi
finish

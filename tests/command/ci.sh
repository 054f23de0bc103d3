#!/usr/bin/env bash
# The scripts in .ci name programs and tests that there are.
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
finish

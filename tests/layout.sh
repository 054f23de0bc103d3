#!/usr/bin/env bash
# The code has the layout that .clang-format describes, as clang-format 14 has it, which is Debian 12's. This gives it:
#
#   git ls-files '*.h' '*.cpp' | xargs clang-format -i
set -uo pipefail
source "$(dirname "$0")/command/expect.sh"

if [[ $(clang-format --version 2>/dev/null) == *" version 14."* ]]; then
    # --dry-run of that version also reports lines that it does not change.
    cp "$source_folder/.clang-format" .
    (cd "$source_folder" && find src povref tests \( -name '*.h' -o -name '*.cpp' \) -print0) >files
    (cd "$source_folder" && xargs -0 cp --parents -t "$work") <files
    xargs -0 -n 50 -P "$(nproc)" clang-format -i <files
    while IFS= read -r -d '' file; do
        cmp -s "$file" "$source_folder/$file" || fault "$(diff -u "$source_folder/$file" "$file")"
    done <files
else
    left_out "clang-format 14 is not installed"
fi
finish

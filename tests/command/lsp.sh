#!/usr/bin/env bash
# strahl lsp: the program as an editor starts it. The test lsp asks it everything that it knows.
set -uo pipefail
source "$(dirname "$0")/expect.sh"
LC_ALL=C # lengths are in bytes

send() { printf 'Content-Length: %d\r\n\r\n%s' "${#1}" "$1"; }
ask() { send '{"jsonrpc":"2.0","id":'"$1"',"method":"'"$2"'","params":'"${3:-{\}}"'}'; }
tell() { send '{"jsonrpc":"2.0","method":"'"$1"'","params":'"${2:-{\}}"'}'; }
text='"textDocument":{"uri":"file://'$work'/new%20\u00e4.rt"'

# Both ways are open, as an editor has them: each answer is awaited before the session goes on.
coproc server { "$strahl" lsp --stdio 2>errors; }
session=$server_PID # the shell forgets this variable when the session has ended
await() { # TEXT
    local header length
    read -r -t 60 header <&"${server[0]}" || { fault "no answer with '$1': $(<errors)"; return; }
    length=${header//[!0-9]/}
    read -r header <&"${server[0]}"
    IFS= read -r -N "$length" -t 60 said <&"${server[0]}"
    [[ $said == *"$1"* ]] || fault "no '$1' in the answer $said"
}
exec {to}>&"${server[1]}"
ask 1 initialize >&"$to"
await '"hoverProvider":true'
tell initialized >&"$to"
tell textDocument/didOpen '{'"$text"',"version":3,"text":"// \u00e4\nshpere { }"}}' >&"$to"
await "did you mean 'sphere'?"
[[ $said == *'"line":1'*'"severity":1'*'"version":3'* ]] || fault "the error is published as $said"
ask 2 textDocument/hover '{'"$text"'},"position":{"line":1,"character":2}}' >&"$to"
await '"result":null'
tell textDocument/didChange '{'"$text"',"version":4},"contentChanges":[{"text":"sphere { }"}]}' >&"$to"
await "no camera"
ask 3 textDocument/hover '{'"$text"'},"position":{"line":0,"character":2}}' >&"$to"
await "radius: the radius"
ask 4 shutdown >&"$to"
await '"id":4'
tell exit >&"$to"
wait "$session" || fault "the session ends with status $?: $(<errors)"
[[ ! -s errors ]] || fault "it says $(<errors)"
exec {to}>&-

# A session without an end, and no session at all.
ask 1 initialize | "$strahl" lsp >answer || (($? == 1)) || fault "an editor that ends gives status $?"
grep -q capabilities answer || fault "the answer is $(<answer)"
echo "sphere { }" | "$strahl" lsp >answer 2>errors
((PIPESTATUS[1] == 3)) || fault "a scene is taken for a message: $(<answer)"
grep -q "Content-Length" errors || fault "it says $(<errors)"
rm answer errors
expect 0 "Language Server Protocol" lsp --help
expect_only scene.rt
finish

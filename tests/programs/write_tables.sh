#!/bin/sh
# SPDX-License-Identifier: MIT
# The script examples/write-tables: it writes what a command prints between the marks, and nothing else.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
write_tables=$root/examples/write-tables
. "$(dirname "$0")/shared"

cat >page.md <<'PAGE'
# A page
<!-- table one: printf '\n| a |\n| --- |\n| 1 |\n' -->
old
<!-- end one -->
between
<!-- table two-quick: printf '| b |\n' && pwd >&2 -->
<!-- end two-quick -->
<!-- table three: printf 'no table\n' -->
<!-- end three -->
after
PAGE
cp page.md original.md
"$write_tables" --file page.md one 2>/dev/null || fail "one table"
[ "$(sed -n '3,5p' page.md | tr '\n' ' ')" = "| a | | --- | | 1 | " ] || fail "$(cat page.md)"
grep -q "^\*Revision .* cores, [0-9]* s\.\*$" page.md || fail "no stamp: $(cat page.md)"
! grep -q "^old$" page.md || fail "what was there has stayed"
[ "$(grep -c "^between$\|^after$\|^# A page$" page.md)" -eq 3 ] || fail "the rest of the page has changed"
cp page.md once.md
"$write_tables" --file page.md one 2>/dev/null
sed 's/, [0-9]* s\.\*$//' page.md >a.txt
sed 's/, [0-9]* s\.\*$//' once.md >b.txt
cmp a.txt b.txt || fail "a second time gives another page"

"$write_tables" --file page.md '*-quick' 2>where.txt || fail "a pattern"
grep -q "^| b |$" page.md || fail "the pattern's table is missing"
[ "$(head -n 1 where.txt)" != "$(pwd)" ] || fail "the command ran in this folder"
[ "$("$write_tables" --list --within 100 --file page.md | cut -d: -f1 | tr '\n' ' ')" = "one two-quick " ] ||
    fail "--within: $("$write_tables" --list --within 100 --file page.md)"
[ "$("$write_tables" --list --stale --file original.md | wc -l)" -eq 3 ] || fail "tables that were never made are not stale"

refuses() { # words in the message, arguments
    words=$1
    shift
    status=0
    "$write_tables" "$@" >out.txt 2>errors.txt || status=$?
    [ $status -eq 1 ] || fail "status $status for: $*"
    grep -q -- "$words" errors.txt || fail "no '$words' for $*: $(cat errors.txt)"
}
cp page.md before.md
refuses "prints no table" --file page.md three
cmp page.md before.md || fail "a command that fails has changed the page"
refuses "no such table" --file page.md four
refuses "there is no" --file nowhere.md
refuses "which page" --file
refuses "no option" --soon
refuses "whole number" --within soon --file page.md
echo "<!-- table open: true -->" >open.md
refuses "no line" --file open.md

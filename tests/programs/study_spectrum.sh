#!/bin/sh
# SPDX-License-Identifier: MIT
# `study spectrum` on few walks: its tables are whole, the tangent needs at most a quarter of the walks of brute force, and
# mistakes are named. The first argument is the programs' folder.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
. "$root/tests/programs/shared"
study=$1/study
[ -x "$study" ] || exit 77
! is_sanitized || exit 77 # the methods themselves are tested under sanitizers

"$study" spectrum --walks 1000,4000 --size 48 --output out --markdown >tables.md 2>errors.txt || fail "$(cat errors.txt)"
for title in "Error in 16 bands" "Error in three colours" "Walks for equal error" "Seconds"; do
    grep -q "$title" tables.md || fail "no table '$title': $(cat tables.md)"
done
! grep -q -e nan -e inf tables.md || fail "a figure is missing: $(cat tables.md)"
[ -s out/report.html ] || fail "no page"
# With 1000 walks the tangent has less error than brute force with four times as many, in bands and in colours.
awk -F'|' '/Error in/ { table = $0 } $2 ~ /^ *1000 *$/ && !(table in few) { few[table] = $3 }
    $2 ~ /^ *4000 *$/ && !(table in many) { many[table] = $5 }
    END { for (t in few) { ++n; if (!(few[t] < many[t])) exit 1 } exit n != 2 }' tables.md || fail "it is no better: $(cat tables.md)"

refuses() { # words in the message, arguments
    words=$1
    shift
    must_refuse 2 "$words" "$study" spectrum "$@"
}
refuses "size" --size 4
refuses "--walks" --walks 5

#!/bin/sh
# SPDX-License-Identifier: MIT
# `study judge`: on scenes that no rule was tuned on, the default is not worse than the published method by more than noise,
# and mistakes are named. The first argument is the programs' folder.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
. "$root/tests/programs/shared"
study=$1/study
[ -x "$study" ] || exit 77
! is_sanitized || exit 77 # which takes minutes for what is tested elsewhere

"$study" judge --seed 21 --photons 20000 --truth 400000 --size 64 --threads 2 --format markdown >table.md 2>errors.txt ||
    fail "$(cat errors.txt)"
[ "$(grep -c '^| .*, 21 |' table.md)" -eq 21 ] || fail "not 21 scenes: $(cat table.md)"
! grep -q -e nan -e inf -e dark table.md || fail "a figure is missing: $(cat table.md)"
# The truth has noise of its own, of 400,000 photons.
awk -F'|' '$2 ~ /geometric mean/ { mean = $4 } $2 ~ /worst/ { worst = $4 }
    END { exit !(mean > 0 && mean < 0.8 && worst < 1.1) }' table.md || fail "the default loses: $(cat table.md)"
"$study" judge --seed 21 --kinds ring --lamps sun --photons 2000 --truth 100000 --size 32 --best >table.txt 2>errors.txt ||
    fail "$(cat errors.txt)"
grep -q ' / ' table.txt || fail "no best s: $(cat table.txt)"

refuses() { # words in the message, arguments
    words=$1
    shift
    must_refuse 2 "$words" "$study" judge "$@"
}
refuses "there is no 'gem'" --kinds gem
refuses "there is no 'torch'" --lamps sun,torch
refuses "--photons" --photons 5
refuses "--sequence: one at a time" --sequence r2,random

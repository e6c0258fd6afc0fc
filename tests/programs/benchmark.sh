#!/bin/sh
# SPDX-License-Identifier: MIT
# The program `benchmark`: that it runs, what its table looks like, and what it says of what it cannot do. Not its times. The
# argument is the folder of the programs.
set -eu
benchmark=$1/benchmark
[ -x "$benchmark" ] || benchmark=$1/benchmarks # as Meson builds it
[ -x "$benchmark" ] || exit 77
. "$(dirname "$0")/shared"

"$benchmark" matrix relax --seconds 0.001 --repetitions 1 >table.txt 2>errors.txt
[ ! -s errors.txt ] || fail "$(cat errors.txt)"
# A heading of two lines; each row has six columns, of which the ratio is a positive number, and a bar is met or missed.
[ "$(wc -l <table.txt)" -gt 5 ] || fail "few rows: $(cat table.txt)"
awk -F'|' 'NF != 8 { exit 1 }
           NR > 2 && $2 ~ /^ *$/ { exit 1 }
           NR > 2 && !($5 + 0 > 0) { exit 1 }
           NR > 2 && $6 ~ /[0-9]/ && $7 !~ /^ (met|missed) *$/ { exit 1 }' table.txt || fail "$(cat table.txt)"
grep -q "filter matrix, float.*glm::inverse" table.txt || fail "no row of the filter matrix: $(cat table.txt)"
grep -q "relaxation.*nanoflann" table.txt || fail "no row of relaxation: $(cat table.txt)"

refuses() { # words in the message, arguments
    words=$1
    shift
    must_refuse 2 "$words" "$benchmark" "$@"
}
refuses "nothing-like-it" matrix nothing-like-it
refuses "repetitions" matrix --repetitions 0
refuses "only under valgrind" matrix --instructions
refuses "no-such-option" --no-such-option

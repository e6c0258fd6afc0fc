#!/bin/sh
# SPDX-License-Identifier: MIT
# The program `reference_path_tracer` as its users meet it: two pictures, the same bits for any number of threads, and
# what it says of what it cannot do. The argument is the folder of the programs.
set -eu
tracer=$1/reference_path_tracer
[ -x "$tracer" ] || exit 77
. "$(dirname "$0")/shared"

columns=24 rows=20
! is_sanitized || columns=4 rows=3
for threads in 1 3; do
    "$tracer" ring-disk --size ${columns}x$rows --samples 64 --threads $threads --output mean$threads.pfm \
        --standard-error se$threads.pfm >out.txt 2>errors.txt || fail "ring-disk: $(cat errors.txt)"
    ! grep -v " paths a pixel, " errors.txt || fail "ring-disk: $(cat errors.txt)" # which slow machines are told meanwhile
    grep -q "64 paths a pixel" out.txt || fail "does not say how many paths: $(cat out.txt)"
done
cmp mean1.pfm mean3.pfm && cmp se1.pfm se3.pfm || fail "the picture depends on the number of threads"
# So many floats behind the header.
[ "$(head -n 2 mean1.pfm | tail -n 1)" = "$columns $rows" ] || fail "the wrong size: $(head -n 2 mean1.pfm | tail -n 1)"
"$tracer" ring-disk-zoom --size 8 --samples 1e9 --seconds 0 --output zoom.png >out.txt || fail "ring-disk-zoom"
grep -q "^32 paths a pixel" out.txt || fail "--seconds does not end it: $(cat out.txt)"

# A refusal is one line on stderr, a status that is not zero, and no file.
refuses() { # words in the message, arguments
    words=$1
    shift
    rm -f refused.pfm
    status=0
    "$tracer" "$@" --output refused.pfm >out.txt 2>errors.txt || status=$?
    [ $status -eq 2 ] || fail "status $status for: $*"
    [ "$(wc -l <errors.txt)" -eq 1 ] || fail "not one line for $*: $(cat errors.txt)"
    grep -q -- "$words" errors.txt || fail "no '$words' for $*: $(cat errors.txt)"
    [ ! -e refused.pfm ] || fail "left a picture behind: $*"
}
refuses "no area" wave-focused
refuses "no area" ball-point
refuses "nowhere" nowhere
refuses "size" ring-disk --size 0
refuses "samples" ring-disk --samples 0
refuses "seconds" ring-disk --seconds -1
refuses "seconds" ring-disk --seconds nan
refuses "reflections" ring-disk --reflections two
refuses "no-such-option" ring-disk --no-such-option
status=0
"$tracer" ring-disk --output x.jpg >/dev/null 2>errors.txt || status=$?
[ $status -eq 1 ] && grep -q "jpg" errors.txt || fail "wrote a .jpg"

#!/bin/sh
# SPDX-License-Identifier: MIT
# The program `relaxation` as its users meet it: its pictures and tables, the same for any number of threads, and what it
# says of what it cannot do. The argument is the folder of the programs.
set -eu
relaxation=$1/relaxation
[ -x "$relaxation" ] || exit 77
. "$(dirname "$0")/shared"

quick="--photons 3000 --size 64 --neighbours 20,50 --sweep 20,50 --iterations 5"
! is_sanitized || quick="--photons 600 --size 32 --neighbours 20,50 --sweep 20,50 --iterations 2"

# shellcheck disable=SC2086 # a list of words
{
    "$relaxation" uniform --sequence random $quick --output uniform >uniform.txt 2>errors.txt
    "$relaxation" ellipse-and-bars $quick --output pattern >pattern.txt 2>>errors.txt
    "$relaxation" pattern/truth.png $quick --output guide >guide.txt 2>>errors.txt
    "$relaxation" wave-prefocal $quick --output wave >wave.txt 2>>errors.txt
    "$relaxation" ring $quick --output ring >ring.txt 2>>errors.txt
}
[ ! -s errors.txt ] || fail "$(cat errors.txt)"
for folder in uniform pattern guide wave ring; do
    for file in truth.png before-20.png after-20.png before-50.png after-50.png before-best.png dots-before.png \
                dots-after.png features.png table.csv; do
        [ -s $folder/$file ] || fail "no $folder/$file"
    done
    # A header, two unrelaxed maps, their two best, two relaxed maps.
    [ "$(wc -l <$folder/table.csv)" -eq 7 ] || fail "$folder/table.csv: $(cat $folder/table.csv)"
    grep -q "times its rel" $folder.txt || fail "$folder: no verdict"
done
[ -s uniform/spectrum.dat ] && [ -s uniform/spectrum-after.png ] || fail "no spectrum of uniform photons"
[ -s pattern/edges.dat ] || fail "no edges of the pattern"
if command -v gnuplot >/dev/null; then
    [ -s uniform/spectrum.svg ] && [ -s pattern/edge-bars.svg ] || fail "gnuplot is there, and plots are not"
else
    grep -q "gnuplot did not run" uniform.txt || fail "does not say that gnuplot is missing"
fi

# What relaxing is for: less error with the same few neighbours. The numbers of a row are the map's, k, seconds, rel, …
rel() { # folder, map, neighbours
    awk -F, "\$1 == \"$2\" && \$2 == $3 { print \$4 }" "$1/table.csv"
}
for folder in uniform pattern guide; do
    is_sanitized || awk "BEGIN { exit !($(rel $folder relaxed 20) < $(rel $folder unrelaxed 20)) }" </dev/null ||
        fail "$folder: relaxing did not help"
done

for threads in 1 3; do
    # shellcheck disable=SC2086
    "$relaxation" ring $quick --threads $threads --output t$threads >/dev/null
done
cmp t1/after-20.png t3/after-20.png && cmp t1/dots-after.png t3/dots-after.png ||
    fail "the pictures depend on the number of threads"

"$relaxation" --timing --photons 2000 >timing.txt 2>errors.txt || fail "$(cat errors.txt)"
grep -q "feature search" timing.txt && grep -q "one iteration" timing.txt || fail "no timing: $(cat timing.txt)"
# shellcheck disable=SC2086
"$relaxation" ring $quick --keep-density on --kernel biweight --samples 4 --output kept >kept.txt 2>errors.txt ||
    fail "$(cat errors.txt)"
[ -s kept/after-20.png ] || fail "no kept/after-20.png"

# A refusal is one line on stderr and a status: 2 for what makes no sense, 1 for what does not work out.
refuses() { # status, words in the message, arguments
    expected=$1 words=$2
    shift 2
    status=0
    "$relaxation" "$@" --output refused >out.txt 2>errors.txt || status=$?
    [ $status -eq "$expected" ] || fail "status $status for: $*"
    [ "$(wc -l <errors.txt)" -eq 1 ] || fail "not one line for $*: $(cat errors.txt)"
    grep -q -- "$words" errors.txt || fail "no '$words' for $*: $(cat errors.txt)"
    [ ! -e refused ] || fail "left a folder behind: $*"
}
printf 'no picture' >broken.png
printf 'glTF\002\000\000\000\100\000\000\000' >broken.glb
refuses 1 "no-such.png" no-such.png
refuses 1 "broken.png" broken.png
refuses 1 "broken.glb" broken.glb
refuses 2 "nowhere" nowhere
refuses 2 "name a subject"
refuses 2 "samples" ring --samples 0
refuses 2 "photons" ring --photons 0
refuses 2 "neighbours" ring --neighbours 20,few
refuses 2 "alpha" ring --features 0.9 0.1
refuses 2 "constrain" ring --constrain maybe
refuses 2 "no-such-option" ring --no-such-option
status=0
"$relaxation" uniform --output broken.png/x >/dev/null 2>errors.txt || status=$?
[ $status -eq 1 ] && grep -q "broken.png" errors.txt || fail "wrote into a file: $(cat errors.txt)"

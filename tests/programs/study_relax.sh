#!/bin/sh
# SPDX-License-Identifier: MIT
# `study relax` as its users meet it: its pictures and tables, the same for any number of threads, and what it
# says of what it cannot do. The argument is the folder of the programs.
set -eu
study=$1/study
[ -x "$study" ] || exit 77
. "$(dirname "$0")/shared"

quick="--photons 3000 --size 64 --neighbours 20,50 --sweep 20,50 --iterations 5"
! is_sanitized || quick="--photons 600 --size 32 --neighbours 20,50 --sweep 20,50 --iterations 2"

# shellcheck disable=SC2086 # a list of words
{
    "$study" relax uniform --sequence random $quick --output uniform >uniform.txt 2>errors.txt
    "$study" relax ellipse-and-bars $quick --output pattern >pattern.txt 2>>errors.txt
    "$study" relax pattern/pictures/ellipse-and-bars/truth.png $quick --output guide >guide.txt 2>>errors.txt
    "$study" relax wave-prefocal $quick --output wave >wave.txt 2>>errors.txt
    "$study" relax ring $quick --output ring >ring.txt 2>>errors.txt
}
[ ! -s errors.txt ] || fail "$(cat errors.txt)"
for run in uniform:uniform pattern:ellipse-and-bars guide:truth wave:wave-prefocal ring:ring; do
    folder=${run%:*} subject=${run#*:}
    for file in truth before-20 after-20 before-50 after-50 before-best dots-before dots-after features; do
        [ -s $folder/pictures/$subject/$file.png ] || fail "no $folder/pictures/$subject/$file.png"
    done
    [ -s $folder/report.html ] || fail "no $folder/report.html"
    # A header, two unrelaxed maps, their two best, two relaxed maps.
    [ "$(wc -l <$folder/$subject.csv)" -eq 7 ] || fail "$folder/$subject.csv: $(cat $folder/$subject.csv)"
    cp $folder/$subject.csv $folder.csv
    grep -q "^Relaxed against" $folder.txt || fail "$folder: no verdict"
done
[ -s uniform/pictures/uniform/spectrum-after.png ] && grep -q "^Spectrum" uniform.txt || fail "no spectrum"
if command -v gnuplot >/dev/null; then
    [ -s uniform/plots/uniform/spectrum-power.svg ] && [ -s pattern/plots/ellipse-and-bars/edge-bars.svg ] ||
        fail "gnuplot is there, and plots are not"
else
    grep -q "gnuplot is missing" uniform.txt || fail "does not say that gnuplot is missing"
fi

# Several subjects at once: a row of the verdict for each.
# shellcheck disable=SC2086
"$study" relax uniform ring $quick --output both --markdown --table verdict >both.md 2>errors.txt ||
    fail "two subjects: $(cat errors.txt)"
[ "$(grep -c '^|' both.md)" -eq 4 ] || fail "not a row for each of two subjects: $(cat both.md)"

# What relaxing is for: less error with the same few neighbours. The numbers of a row are the map's, k, seconds, rel, …
rel() { # folder, map, neighbours
    awk -F, "\$1 == \"$2\" && \$2 == $3 { print \$4 }" "$1.csv"
}
for folder in uniform pattern guide; do
    is_sanitized || awk "BEGIN { exit !($(rel $folder relaxed 20) < $(rel $folder unrelaxed 20)) }" </dev/null ||
        fail "$folder: relaxing did not help"
done

for threads in 1 3; do
    # shellcheck disable=SC2086
    "$study" relax ring $quick --threads $threads --output t$threads >/dev/null
done
cmp t1/pictures/ring/after-20.png t3/pictures/ring/after-20.png &&
    cmp t1/pictures/ring/dots-after.png t3/pictures/ring/dots-after.png ||
    fail "the pictures depend on the number of threads"

"$study" relax --timing --photons 2000 --output timing >timing.txt 2>errors.txt || fail "$(cat errors.txt)"
grep -q "feature search" timing.txt && grep -q "one iteration" timing.txt || fail "no timing: $(cat timing.txt)"
# shellcheck disable=SC2086
"$study" relax ring $quick --keep-density on --kernel biweight --samples 4 --output kept >kept.txt 2>errors.txt ||
    fail "$(cat errors.txt)"
[ -s kept/pictures/ring/after-20.png ] || fail "no picture of the map that keeps its density"

# A refusal is one line on stderr and a status: 2 for what makes no sense, 1 for what does not work out.
refuses() { # status, words in the message, arguments
    expected=$1 words=$2
    shift 2
    must_refuse "$expected" "$words" "$study" relax "$@" --output refused
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
"$study" relax uniform --output broken.png/x >/dev/null 2>errors.txt || status=$?
[ $status -eq 1 ] && grep -q "broken.png" errors.txt || fail "wrote into a file: $(cat errors.txt)"

#!/bin/sh
# SPDX-License-Identifier: MIT
# `study compare` as its users meet it: figures as CSV and JSON, pictures, plots, a page that needs no other file, and what
# it says of what it cannot do. The argument is the folder of the programs.
set -eu
study=$1/study
[ -x "$study" ] || exit 77
. "$(dirname "$0")/shared"

many=2000 few=1000 few_in_words="1 000" size=64
! is_sanitized || many=400 few=200 few_in_words=200 size=32
"$study" compare wave-prefocal --photons $many,$few --size $size --methods splat,nearest --threads 2 --repeats 2 --output out \
    >out.txt 2>errors.txt || fail "the small comparison: $(cat errors.txt)"
# On stderr one line for each method, sequence and count, as it is finished.
says_only_progress() {
    ! grep -v "^[a-z]* .* rel .* RMSE .* SSIM " errors.txt || fail "words on stderr: $(cat errors.txt)"
}
says_only_progress
[ "$(wc -l <errors.txt)" -eq 8 ] || fail "not a line for each trial: $(cat errors.txt)"
for words in "Equal error: splatting with halton, rivals with random" "Equal time: $few_in_words halton" "Convergence"; do
    grep -q "$words" out.txt || fail "no '$words' among the tables"
done

# The CSV: as many columns in each row as in the header, two methods with two sequences and two counts, the best by each
# measure once for each, no figure missing or out of range.
csv=out/results.csv
header="case,sequence,method,photons,caustic_photons,emitted,bandwidth_name,bandwidth,rel,rmse,ssim,energy,best_by"
header="$header,trace_seconds,build_seconds,estimate_seconds,total_seconds,least_seconds,most_seconds,repeats"
header="$header,photons_per_second,peak_memory"
[ "$(head -n 1 $csv)" = "$header" ] || fail "the header is $(head -n 1 $csv)"
awk -F, 'NR > 1 && (NF != 22 || !($8 > 0) || !($9 > 0 && $9 < 2) || !($11 > -1 && $11 < 1)) { exit 1 }' $csv ||
    fail "a row is not as the header says"
awk -F, 'NR > 1 && $13 != "" && !($17 > 0 && $18 <= $17 && $17 <= $19 && $20 == 2) { exit 1 }' $csv ||
    fail "a timing is missing, or not between the fastest and the slowest run"
for measure in rel RMSE SSIM; do
    [ "$(cut -d, -f13 $csv | grep -c $measure)" -eq 8 ] || fail "not eight rows that are best by $measure"
    # No other row of its method, sequence and count is better.
    awk -F, -v m=$measure 'NR > 1 { c = m == "rel" ? $9 : m == "RMSE" ? $10 : 1 - $11; t = $2 $3 $4
        if (!(t in least) || c < least[t]) least[t] = c
        if (index($13, m)) best[t] = c }
        END { for (t in least) if (best[t] > 1.001 * least[t]) exit 1 }' $csv ||
        fail "the best by $measure is not the best"
done
# Stratified photons, differentials: the order that this case is known to have.
rel() { awk -F, -v s=$1 -v m=$2 -v n=$many '$2 == s && $3 == m && $4 == n && $13 ~ /rel/ { print $9 }' $csv; }
order="$(rel halton splat) < $(rel random splat) && $(rel random splat) < $(rel random nearest)"
awk "BEGIN { exit !($order) }" </dev/null ||
    fail "splatting is not ahead of photon mapping"

grep -q '"trials": \[' out/results.json || fail "no trials in the JSON"
[ "$(tr -cd '{[' <out/results.json | wc -c)" -eq "$(tr -cd '}]' <out/results.json | wc -c)" ] ||
    fail "the JSON is not balanced"
for picture in reference splat-halton-$few-RMSE nearest-random-$many-SSIM strip-halton-SSIM; do
    [ -s out/pictures/$picture.png ] || fail "no picture $picture.png"
done

# The page stands for itself: nothing in it points elsewhere, and nothing runs.
[ "$(wc -c <out/report.html)" -lt 5000000 ] || fail "the page is $(wc -c <out/report.html) bytes long"
grep -q 'name="viewport"' out/report.html || fail "the page is not for phones"
grep -q 'src="data:image/png;base64,' out/report.html || fail "the page has no pictures"
elsewhere='(src|href|url)[=(] *.?(https?:|//|file:|[a-z./]*\.(png|svg|css|js))|<script|<link|@import|https?://'
if grep -E -i -q "$elsewhere" out/report.html; then
    fail "the page refers to something else"
fi
if command -v gnuplot >/dev/null; then
    [ "$(grep -c '<svg' out/report.html)" -eq 18 ] || fail "$(grep -c '<svg' out/report.html) plots in the page, not 18"
else
    grep -q "gnuplot is missing" out.txt || fail "not a word about the plots that are missing"
fi
# A single count is enough, and gnuplot keeps its warnings to itself.
"$study" compare wave-prefocal --photons 1000 --size 32 --methods splat,nearest --output out >/dev/null 2>errors.txt ||
    fail "a single count: $(cat errors.txt)"
says_only_progress
# Without gnuplot there are tables and pictures, and a note.
mkdir -p no-gnuplot
PATH=$(pwd)/no-gnuplot "$study" compare ring --photons 1000 --size 32 --sequence halton --methods splat --output out \
    >out.txt 2>errors.txt || fail "without gnuplot: $(cat errors.txt)"
grep -q "gnuplot is missing" out.txt || fail "not a word about the plots that are missing"
says_only_progress

# As Markdown the chosen tables, and nothing else.
"$study" compare wave-prefocal --photons 1000 --size 32 --sequence halton --methods splat,light-tracing --output out \
    --markdown --table best-rel >table.md 2>errors.txt || fail "Markdown: $(cat errors.txt)"
[ "$(grep -c '^|' table.md)" -eq 4 ] && ! grep -q "^Equal\|^results" table.md || fail "not one table: $(cat table.md)"
grep -q "nothing to choose" table.md || fail "light tracing has a bandwidth: $(cat table.md)"

# A reference of the user's own: the exact picture's stand-in, with a standard error.
"$1/caustics" wave-prefocal --photons $((15 * many)) --size 32 --output mean.pfm >/dev/null
"$study" compare wave-prefocal --photons 1000 --size 32 --sequence halton --methods splat --reference mean.pfm \
    --standard-error mean.pfm --output out >/dev/null 2>errors.txt || fail "a reference: $(cat errors.txt)"
grep -q '"reference": "mean.pfm"' out/results.json || fail "the reference is not named in the JSON"

# A refusal is one line on stderr: status 2 for bad usage, 1 for what fails.
refuses() { # status, words in the message, arguments
    expected=$1 words=$2
    shift 2
    must_refuse "$expected" "$words" "$study" compare "$@" --output refused
}
refuses 2 "no-such-case" no-such-case
refuses 2 "case" --photons 1000
refuses 2 "guess" ring --methods splat,guess
refuses 2 "empty" ring --methods splat,,fixed
refuses 2 "photons" ring --photons 1000,many
refuses 2 "photons" ring --photons 5
refuses 2 "sequence" ring --sequence sometimes
refuses 2 "size" ring --size 8
refuses 2 "samples" ring --samples 0
refuses 2 "repeats" ring --repeats 0
refuses 2 "threads" ring --threads 5000
refuses 2 "view" wave-focused --view 0 2 0 1
refuses 2 "fresnel" ring --fresnel on
refuses 2 "standard-error" ring --standard-error mean.pfm
refuses 2 "table" ring --table no-such-table
refuses 2 "no-such-option" ring --no-such-option
refuses 1 "no-such.pfm" ring --reference no-such.pfm
refuses 1 "32 x 32" ring --size 64 --reference mean.pfm
refuses 1 "no light" ring --view 50 51 50 51 --size 16
status=0
"$study" compare ring --photons 1000 --size 16 --output mean.pfm/x >/dev/null 2>errors.txt || status=$?
[ $status -eq 1 ] && grep -q "mean.pfm" errors.txt || fail "wrote into a file: $(cat errors.txt)"
status=0
"$study" >out.txt 2>errors.txt || status=$?
[ $status -eq 2 ] && [ "$(wc -l <errors.txt)" -eq 1 ] || fail "no question: $(cat errors.txt)"
for question in compare smoothing relax; do
    "$study" --help | grep -q "$question" || fail "--help does not name $question"
    "$study" $question --help | grep -q -- "--output" || fail "$question --help does not list its options"
done

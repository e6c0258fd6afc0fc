#!/bin/sh
# SPDX-License-Identifier: MIT
# `study smoothing`: its tables, its figures, its page, and what it says of what it cannot do. The argument is the folder of
# the programs.
set -eu
study=$1/study
[ -x "$study" ] || exit 77
. "$(dirname "$0")/shared"

photons=2000,8000 size=64
! is_sanitized || photons=200,400 size=32
"$study" smoothing --cases wave-prefocal,ring --photons $photons --size $size --output out --markdown \
    >tables.md 2>errors.txt ||
    fail "$(cat errors.txt)"
for title in "Equal photons" "Equal time" "Convergence"; do
    grep -q "^$title" tables.md || fail "no table '$title'"
done
! grep -q "nan" tables.md || fail "a figure is missing: $(cat tables.md)"
# Two cases with two sequences and two counts, three ways of splatting; each is the best of its way by three measures.
csv=out/results.csv
awk -F, 'NR > 1 && (NF != 22 || !($8 > 0) || !($9 > 0)) { exit 1 }' $csv || fail "a row is not as the header says"
for measure in rel RMSE SSIM; do
    [ "$(cut -d, -f13 $csv | grep -c $measure)" -eq 24 ] || fail "not 24 rows that are best by $measure"
done
[ -s out/report.html ] || fail "no page"
# Second order is ahead of first order at its best s: 0.27 on this case with 5,000 photons.
is_sanitized ||
    awk -F'|' '$2 ~ /wave-prefocal/ && $3 ~ /halton/ { split($4, ratio, "/"); exit !(ratio[1] > 0 && ratio[1] < 0.6) }' \
        tables.md || fail "wave-prefocal: $(cat tables.md)"

refuses() { # words in the message, arguments
    words=$1
    shift
    must_refuse 2 "$words" "$study" smoothing "$@"
}
refuses "cases" --cases ring,none
refuses "photons" --photons 5
refuses "size" --size 8
refuses "smoothing" --fixed-smoothing 0
refuses "fresnel" --fresnel on
refuses "reference" --cases ring-disk
refuses "reference" --cases ring,ball --reference some.pfm

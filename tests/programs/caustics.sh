#!/bin/sh
# SPDX-License-Identifier: MIT
# The program `caustics` as its users meet it: pictures, statistics, the same bits for any number of threads, and what
# it says of what it cannot do. The argument is the folder of the programs.
set -eu
caustics=$1/caustics
[ -x "$caustics" ] || exit 77
. "$(dirname "$0")/shared"

# What each case says of itself, in a number that the statistics name: `value file "name"`.
value() {
    sed -n "s/^ *\"$2\": \([-+0-9.e]*\),*$/\1/p" "$1" | head -n 1
}

at_most() { # value, bound, what
    awk "BEGIN { exit !($1 <= $2 && $1 >= -($2)) }" </dev/null || fail "$3: $1 is beyond $2"
}

for scene in wave-focused wave-prefocal ring ring-zoom ball ball-point; do
    "$caustics" $scene --photons 2000 --size 64 --output $scene.pfm --json $scene.json >$scene.txt 2>errors.txt
    [ ! -s errors.txt ] || fail "$scene: $(cat errors.txt)"
    grep -q "energy error" $scene.txt || fail "$scene: no table"
    # Floats summed over a few thousand photons, in double: the account must balance far below 1e-5.
    emitted=$(value $scene.json "flux emitted")
    accounted=$(value $scene.json "flux accounted")
    at_most "($emitted - $accounted) / $emitted" 1e-5 "$scene: the account"
done

"$caustics" --version | grep -q -x 'nephroid [0-9]*\.[0-9]*\.[0-9]*' || fail "--version: no version"

at_least() { # value, bound, what
    awk "BEGIN { exit !($1 >= $2) }" </dev/null || fail "$3: $1 is below $2"
}

if is_sanitized; then
    for arguments in "wave-prefocal --smoothing 11 --view 0 1 0 1" "ring-zoom --smoothing cross-validated"; do
        # shellcheck disable=SC2086 # a list of words
        "$caustics" $arguments --first-order --photons 2000 --size 64 --output m.png >/dev/null || fail "$arguments"
    done
    few="--photons 3000 --size 64"
else
    # What 20,000 photons reach against the exact pictures, at 512 x 512.
    measure() { # scene, smoothing, more arguments
        scene=$1 smoothing=$2
        shift 2
        "$caustics" "$scene" --first-order --smoothing "$smoothing" "$@" --output m.png --json m.json >/dev/null ||
            fail "$scene"
        at_most "$(value m.json energy)" 0.001 "$scene, s = $smoothing: energy error"
    }
    measure wave-focused 3
    at_most "$(value m.json rel)" 0.26 "wave-focused, s = 3: rel"
    measure wave-focused 5
    at_most "$(value m.json 'clipped RMSE')" 0.051 "wave-focused, s = 5: clipped RMSE"
    measure wave-focused 8
    at_least "$(value m.json SSIM)" 0.905 "wave-focused, s = 8: SSIM"
    measure wave-prefocal 11
    at_most "$(value m.json rel)" 0.027 "wave-prefocal, s = 11: rel"
    at_least "$(value m.json SSIM)" 0.996 "wave-prefocal, s = 11: SSIM"
    measure wave-prefocal 11 --view 0 1 0 1
    at_most "$(value m.json rel)" 0.027 "wave-prefocal as a view of the whole: rel"
    measure ring-zoom 5
    at_most "$(value m.json rel)" 0.16 "ring-zoom, s = 5: rel"
    measure ring-zoom cross-validated # chooses 5.0
    at_most "$(value m.json rel)" 0.16 "ring-zoom, cross-validated s: rel"
    measure ring-zoom 8 --photons 1280000
    at_most "$(value m.json rel)" 0.09 "ring-zoom, s = 8, 1,280,000 photons: rel"

    # The same photons to second order, with nothing to choose.
    for scene in wave-focused wave-prefocal ring-zoom; do
        "$caustics" $scene --output m.png --json $scene.json >/dev/null || fail "$scene, second order"
        at_most "$(value $scene.json energy)" 0.001 "$scene, second order: energy error"
    done
    at_most "$(value wave-focused.json rel)" 0.165 "wave-focused, second order: rel"
    at_most "$(value wave-focused.json 'clipped RMSE')" 0.046 "wave-focused, second order: clipped RMSE"
    at_most "$(value wave-prefocal.json rel)" 0.016 "wave-prefocal, second order: rel"
    at_least "$(value wave-prefocal.json SSIM)" 0.999 "wave-prefocal, second order: SSIM"
    at_most "$(value ring-zoom.json 'clipped RMSE')" 0.0225 "ring-zoom, second order: clipped RMSE"
    at_least "$(value ring-zoom.json SSIM)" 0.95 "ring-zoom, second order: SSIM"
    few="--photons 30000 --size 128"
fi

for scene in ring wave-focused; do
    for threads in 1 2 7; do
        # shellcheck disable=SC2086
        "$caustics" $scene $few --threads $threads --output t$threads.pfm >/dev/null
    done
    cmp t1.pfm t2.pfm && cmp t1.pfm t7.pfm || fail "$scene: the picture depends on the number of threads"
done

# Memory is the map and one batch, whatever the number of photons. Sanitizers keep what is freed.
if ! is_sanitized; then
    for photons in 1e5 1e6; do
        "$caustics" wave-focused --photons $photons --output m.png --json memory-$photons.json >/dev/null
    done
    less=$(value memory-1e5.json "peak memory") more=$(value memory-1e6.json "peak memory")
    at_most "$more" "1.05 * $less" "peak memory grows with the photons"
fi
# shellcheck disable=SC2086
"$caustics" ring $few --output m.exr >/dev/null || fail "ring as .exr"
"$caustics" ring --view -.5 .5 -.5 .5 --size 32 --output m.png >/dev/null || fail "a view of negative numbers"

# A refusal is one line on stderr, a status that is not zero, and no file.
refuses() { # words in the message, arguments
    words=$1
    shift
    rm -f refused.png
    status=0
    "$caustics" "$@" --output refused.png >out.txt 2>errors.txt || status=$?
    [ $status -ne 0 ] || fail "accepted: $*"
    [ $status -lt 126 ] || fail "crashed: $*"
    [ "$(wc -l <errors.txt)" -eq 1 ] || fail "not one line for $*: $(cat errors.txt)"
    grep -q -- "$words" errors.txt || fail "no '$words' for $*: $(cat errors.txt)"
    [ ! -e refused.png ] || fail "left a picture behind: $*"
}
printf 'glTF\002\000\000\000\100\000\000\000' >broken.glb
# A picture against another one: itself, and one of another size.
"$caustics" ring-disk --photons 2000 --size 32 --output own.pfm >/dev/null
"$caustics" ring-disk --photons 2000 --size 32 --output own.pfm --reference own.pfm --json own.json >own.txt
grep -q "against own.pfm" own.txt || fail "does not compare: $(cat own.txt)"
at_most "$(value own.json rel)" 0 "a picture against itself"
refuses "32 x 32" ring-disk --photons 2000 --size 40 --reference own.pfm
refuses "no-such.pfm" ring --reference no-such.pfm
refuses "no-such.glb" no-such.glb
refuses "broken.glb" broken.glb
refuses "photons" ring --photons 0
refuses "photons" ring --photons 1.5
refuses "smoothing" ring --smoothing -1
refuses "smoothing" ring --smoothing nan
refuses "first-order" ring --smoothing cross-validated
refuses "tile" wave-focused --first-order --smoothing cross-validated
refuses "size" ring --size 0
refuses "kernel" ring --kernel box
refuses "view" ring --view 1 0 0 1
refuses "fresnel" ring --fresnel on
refuses "no-such-option" ring --no-such-option
status=0
"$caustics" ring --output no-such-folder/x.png >/dev/null 2>errors.txt || status=$?
[ $status -ne 0 ] && grep -q "no-such-folder" errors.txt || fail "wrote into a folder that does not exist"
status=0
"$caustics" ring --output x.jpg >/dev/null 2>errors.txt || status=$?
[ $status -ne 0 ] && grep -q "jpg" errors.txt || fail "wrote a .jpg"

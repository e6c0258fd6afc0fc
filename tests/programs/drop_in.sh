#!/bin/sh
# SPDX-License-Identifier: MIT
# The renderers of examples/drop_in: how long their adapters are, and that their caustics are those of `caustics`.
#
# Where a renderer traces the very photons that `caustics` does (one light, the same sequence), the two pictures differ by
# rounding alone. Else each is compared with a picture of 20 times as many photons, and must be as close to it as what
# `caustics` makes of as many photons as the renderer's. All differences are rms(E - E') / mean(E'). Under sanitizers the
# renderers run, and nothing is compared.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
programs=$1
[ -x "$programs/drop_in_virtual_shapes" ] && [ -x "$programs/caustics" ] || exit 77
. "$(dirname "$0")/shared"
size=256

# Adapter and call together: at most 80 lines.
for source in "$root"/examples/drop_in/*.cpp; do
    lines=$(sed -n '/^\/\/ adapter begins$/,/^\/\/ adapter ends$/p' "$source" | grep -cv '^// adapter ') || lines=0
    name=$(basename "$source")
    [ "$lines" -gt 20 ] || fail "$name: no adapter between its marks"
    [ "$lines" -le 80 ] || fail "$name: its adapter has $lines lines"
    echo "$name: an adapter of $lines lines"
done

# Our own pictures of the same scenes.
own() { # name, arguments
    ! is_sanitized || return 0
    name=$1
    shift
    "$programs/caustics" "$@" --size $size --output "$name.pfm" >/dev/null || fail "caustics $*"
}

# The samples of one channel as text.
channel() { # file, channel, channels
    tail -c $((4 * size * size * $3)) "$1" | od -An -v -t f4 -w4 | awk -v c="$2" -v n="$3" 'NR % n == (c + 1) % n'
}

# Sets `difference` and `ratio` (of the sums) of a picture to one of ours, times a factor.
compare() { # picture, our picture, [channel, channels, factor]
    difference="" ratio=""
    ! is_sanitized || return 0
    channel "$1" "${3:-0}" "${4:-1}" >a.txt
    channel "$2.pfm" 0 1 >b.txt
    set -- $(paste a.txt b.txt | awk -v f="${5:-1}" '
        { d = f * $1 - $2; squares += d * d; a += f * $1; b += $2 }
        END { if (NR == 0 || b <= 0) exit 1; printf "%.6g %.6g", sqrt(squares / NR) / (b / NR), a / b }')
    difference=$1 ratio=$2
}

at_most() { # what, value, bound
    ! is_sanitized || return 0
    awk "BEGIN { exit !($2 <= $3) }" </dev/null || fail "$1: $2 is above $3"
    echo "$1: $2 (at most $3)"
}

run() { # program, picture, more arguments
    program=$1
    shift
    "$programs/drop_in_$program" "$@" >"$program.txt" || fail "$program $*"
    [ "$(wc -c <"$1")" -gt $((4 * size * size)) ] || fail "$program: its picture has too few pixels"
}

own sun ball --emit 50000 --smoothing 5
own sun-many ball --emit 1000000 --smoothing 9
compare sun.pfm sun-many
sampling=$difference # what 50,000 photons are wrong by

# The same photons. Floats that are rounded otherwise move a photon by about 1e-6 of the ball's radius, a ten-thousandth of
# a footprint, and where the light comes to a focus by tens of times that; at the rim some photon meets the ball or does not,
# and its neighbours, by which second-order footprints go, notice. A twentieth of the sampling error is 0.1% more in all.
run virtual_shapes virtual_shapes.pfm
compare virtual_shapes.pfm sun
at_most "virtual shapes" "$difference" "$sampling / 20"

# The meshes' facets lie 1/8 of their edges' squares below the ball: 19e-6 and 5e-6 of its radius, a hundredth of a
# footprint, and magnified. A fifth of the sampling error is 2% more in all.
run users_tree users_tree.pfm
compare users_tree.pfm sun
at_most "user's tree" "$difference" "$sampling / 5"
if [ -x "$programs/drop_in_embree" ]; then
    run embree embree_user.pfm user
    compare embree_user.pfm sun
    at_most "Embree, user geometry" "$difference" "$sampling / 20"
    run embree embree_mesh.pfm
    compare embree_mesh.pfm sun
    at_most "Embree, mesh" "$difference" "$sampling / 20" # four times finer than the user's tree's
else
    echo "Embree: skipped, it was not found"
fi

# Two lights, in red and green, that share 100,000 photons by power: half each. The choice takes the sequence's first
# dimension, and of what is left each light gets every other photon, so they are less even than ours: by half at most, where
# random photons would be wrong by six times as much.
run pbrt_like pbrt_like.pfm
compare pbrt_like.pfm sun-many 0 3
at_most "pbrt-like, red sun" "$difference" "1.5 * $sampling"
at_most "pbrt-like, red sun's energy" "($ratio - 1) ^ 2" "0.01 ^ 2"
own lamp ball-point --emit 50000 --smoothing 5
own lamp-many ball-point --emit 1000000 --smoothing 9
compare lamp.pfm lamp-many
sampling=$difference
compare pbrt_like.pfm lamp-many 1 3
at_most "pbrt-like, green lamp" "$difference" "1.5 * $sampling"
at_most "pbrt-like, green lamp's energy" "($ratio - 1) ^ 2" "0.01 ^ 2"
compare pbrt_like.pfm lamp-many 2 3
at_most "pbrt-like, blue" "$ratio" 0

# The weekend's glass reflects as Schlick has it, by chance: up to 5% more light passes than by Fresnel's formulas, and each
# photon that the dice take away leaves a gap. A share R of the photons gone at random adds R times the variance of a
# picture by random photons; here R is a tenth and less.
own glass ball --fresnel on --emit 50000 --smoothing 5
own glass-many ball --fresnel on --emit 1000000 --smoothing 9
own glass-random ball --fresnel on --emit 50000 --smoothing 5 --sequence random
compare glass.pfm glass-many
sampling=$difference
compare glass-random.pfm glass-many
random=$difference
run weekend weekend.pfm
compare weekend.pfm glass-many 1 3 6.283185307 # the floor's radiance is 0.5 / pi of its irradiance
at_most "weekend" "$difference" "sqrt($sampling ^ 2 + 0.1 * $random ^ 2 + 0.05 ^ 2)"
at_most "weekend's energy" "($ratio - 1.025) ^ 2" "0.03 ^ 2"

# The room's own sum over its lamp's mirror image. What of a footprint lies beyond the table's edge is lost: 0.04 about an
# edge of 3.2 in an area of 9, by half, and as much in the shadows' borders. The error is that of these borders; between
# them it is that of four emission dimensions, a twentieth (tests/emission/light/lamp_over_mirror_test.cpp).
run lamp_in_room lamp_in_room.pfm
cp lamp_in_room.pfm.exact.pfm room.pfm
compare lamp_in_room.pfm room
at_most "lamp in room" "$difference" 0.15
at_most "lamp in room: energy" "($ratio - 1) ^ 2" "0.04 ^ 2"

# The ring's photons start from a window that two fifths of them reach the mirror through.
own ring ring-zoom --emit 160000 --smoothing 6
own ring-many ring-zoom --emit 3200000 --smoothing 10
compare ring.pfm ring-many
sampling=$difference
run progressive progressive.pfm
compare progressive.pfm ring-many
at_most "progressive" "$difference" "1.2 * $sampling"
# Stopped on the way and resumed: the same bits. On a busy machine the stop may come too late; then once more.
for attempt in 1 2 3 4 5; do
    rm -f stopped.pfm.stopped
    run progressive stopped.pfm stop
    cmp stopped.pfm progressive.pfm || fail "progressive: stopped and resumed, it is another picture"
    [ ! -e stopped.pfm.stopped ] || break
    echo "progressive: not stopped, attempt $attempt"
done
[ -e stopped.pfm.stopped ] || fail "progressive: it does not stop"
# What there was by then: at least a quarter of the photons, whose error falls with their number at best.
compare stopped.pfm.stopped ring-many
at_most "progressive, stopped" "$difference" "4 * $sampling"
at_most "progressive, stopped: energy" "($ratio - 1) ^ 2" "0.01 ^ 2"

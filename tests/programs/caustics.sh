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

# Light sheets: far nearer to the exact pictures with as few photons, and the account balances as well.
for scene in wave-focused ring; do
    "$caustics" $scene --method sheets --photons 2000 --size 64 --output m.png --json m.json >m.txt
    at_most "$(value m.json rel)" 0.1 "$scene, sheets: rel"
    grep -q 'light sheets' m.txt || fail "$scene: no light sheets"
    at_most "($(value m.json 'flux emitted') - $(value m.json 'flux accounted') - $(value m.json 'flux unresolved'))" \
        1e-5 "$scene, sheets: the account"
done
if "$caustics" ring --method sheets --smoothing 3 >/dev/null 2>errors.txt; then fail "sheets have no smoothing"; fi
grep -q -- '--smoothing: is for splats' errors.txt || fail "$(cat errors.txt)"

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
# Passes until their noise is below an error. Two pictures of other photons differ by √2 times as much. They have 24 x 24
# pixels, of which footprints make some hundred independent ones: the two are good to a tenth each, and 1.3 is twice that.
if ! is_sanitized; then
    for scene in "ring-disk --first-order --error 5%" "cornell --layer indirect --error 3.5%"; do
        reference=""
        for seed in 1 2; do
            # shellcheck disable=SC2086
            "$caustics" $scene --photons 2000 --size 24 --sequence random --seed $seed --output $seed.pfm --json m.json \
                $reference >/dev/null
            reference="--reference 1.pfm"
        done
        noise=$(value m.json noise)
        at_most 8 "$(value m.json passes)" "$scene: the passes are too few to be a test"
        at_most "$noise" "$(echo "$scene" | sed 's/.*error \(.*\)%/0.01 * \1/')" "$scene: more noise than was asked for"
        at_most "$(value m.json rel)" "1.3 * 1.4142 * $noise" "$scene: pictures differ by more than their noise"
        at_most "1.4142 * $noise" "1.3 * $(value m.json rel)" "$scene: pictures differ by less than their noise"
    done
    # Fluxes are those of one pass: the lamp's, to the rounding of each photon's.
    "$caustics" ring-disk --first-order --photons 2000 --size 24 --output m.pfm --json one.json >/dev/null
    "$caustics" ring-disk --first-order --photons 2000 --size 24 --error 90% --output m.pfm --json four.json >/dev/null
    at_most "$(value one.json "flux emitted") - $(value four.json "flux emitted")" 1e-5 "passes add up the lamp's flux"
fi
# Ctrl-C ends passes of a single batch too, which are always whole.
status=0
timeout --preserve-status -s INT -k 60 2 "$caustics" cornell --layer indirect --emit 500 --size 16 --error 0.001% \
    --output part.pfm --json part.json >part.txt 2>errors.txt || status=$?
if [ $status -ne 127 ] && ! is_sanitized; then
    [ $status -eq 130 ] || fail "Ctrl-C between passes: status $status, $(cat errors.txt)"
    at_most 2 "$(value part.json passes)" "Ctrl-C between passes: there was one"
fi
"$caustics" cornell --size 16 --photons 500 --error 90% --output m.png --layers layers.exr >m.txt 2>errors.txt ||
    grep -q "without OpenEXR" errors.txt || fail "a room's layers: $(cat m.txt)"
for channel in R direct.R caustics.G indirect.B caustics.variance.Y indirect.variance.Y; do
    [ ! -f layers.exr ] || grep -q -a "$channel" layers.exr || fail "the layers have no channel $channel"
done
"$caustics" ring --view -.5 .5 -.5 .5 --size 32 --output m.png >/dev/null || fail "a view of negative numbers"

# A file of a glass box alone: sun, ground and camera are assumed, and told before the table. The second argument goes
# into the material, the third into the file.
write_box() { # file, material, more
    cat >"$1" <<END
{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"box"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
"materials":[{"name":"glass","pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},"extensions":
{"KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_volume":{"thicknessFactor":1}}${2:-}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"},
{"bufferView":1,"componentType":5121,"count":36,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":36}],
"buffers":[{"byteLength":132,"uri":"data:application/octet-stream;base64,\
AAAAvwAAAAAAAAC/AAAAvwAAAAAAAAA/AAAAvwAAgD8AAAC/AAAAvwAAgD8AAAA/AAAAPwAAAAAAAAC/AAAAPwAA\
AAAAAAA/AAAAPwAAgD8AAAC/AAAAPwAAgD8AAAA/AAEDAAMCBAYHBAcFAAQFAAUBAgMHAgcGAAIGAAYEAQUHAQcD"}]${3:-}}
END
}
write_box box.gltf
"$caustics" box.gltf --photons 2000 --size 64 --output box.pfm --json box.json >box.txt 2>errors.txt ||
    fail "a file without lamp, floor and camera: $(cat errors.txt)"
[ ! -s errors.txt ] || fail "box.gltf: $(cat errors.txt)"
for assumed in "assumed --sun" "assumed --ground 0.8" "no camera in the file"; do
    grep -q "^note: .*$assumed" box.txt || fail "box.gltf: does not say '$assumed': $(cat box.txt)"
done
sed '/^caustics/q' box.txt | grep -q "assumed --sun" || fail "what is assumed is told after the table began"
at_least "$(value box.json 'caustic photons')" 1500 "box.gltf: caustic photons"
# What is asked for is not called assumed, and a sun has the size that it is given.
"$caustics" box.gltf --sun 0,-1,0,5 --ground --environment constant --photons 2000 --size 32 --output box.png >box.txt ||
    fail "box.gltf with all that can be added"
! grep -q "assumed --" box.txt || fail "called assumed what was asked for"

# In bands: glass that does not disperse looks as in three colours, and a layer has a channel for each band.
"$caustics" box.gltf --photons 2000 --size 64 --bands 16 --reference box.pfm --output bands.png --json bands.json \
    --layers bands.exr >box.txt 2>errors.txt || grep -q "without OpenEXR" errors.txt || fail "bands: $(cat errors.txt)"
if [ -f bands.exr ]; then
    at_most "$(value bands.json rel)" 0.05 "bands of white light: rel" # Fresnel draws other numbers
    for channel in caustics.409nm.Y caustics.691nm.Y; do
        grep -q -a "$channel" bands.exr || fail "the layers have no channel $channel"
    done
fi

# The scenes that are built in, with their cameras.
for scene in gold-ring prism embedded-torus swimming-pool; do
    "$caustics" $scene --photons 500 --size 24 --output m.png --json m.json >m.txt 2>errors.txt ||
        fail "$scene: $(cat errors.txt)"
    at_least "$(value m.json 'caustic photons')" 100 "$scene: caustic photons"
done
# A prism parts the colours: without bands all of them lie in one place.
"$caustics" prism --layer caustics --photons 500 --size 24 --output white.pfm >m.txt || fail "prism"
"$caustics" prism --layer caustics --bands 16 --photons 500 --size 24 --reference white.pfm --output m.png \
    --json m.json >m.txt || fail "prism in bands"
at_least "$(value m.json rel)" 0.5 "prism in bands against all in one place: rel"

# Rooms, and light between diffuse surfaces: the same for any number of threads, with its account in the statistics.
few="--photons 5000 --size 24"
for layer in all direct caustics indirect; do
    for threads in 1 3; do
        # shellcheck disable=SC2086
        "$caustics" cornell --layer $layer $few --threads $threads --output $layer$threads.pfm --json $layer.json \
            >$layer.txt 2>errors.txt || fail "cornell, $layer: $(cat errors.txt)"
    done
    cmp ${layer}1.pfm ${layer}3.pfm || fail "cornell, $layer: the picture depends on the number of threads"
done
grep -q '"layer": "indirect"' indirect.json && grep -q '"bounces": "all"' indirect.json ||
    fail "cornell: the statistics do not say of which light they are"
[ "$(value caustics.json bounces)" = 0 ] || fail "cornell: bounces among its caustics"
! grep -q "^note: " direct.txt indirect.txt || fail "notes on passes that were not asked for: $(cat direct.txt)"
grep -q "disks' radius" indirect.txt || fail "cornell: does not say how wide the disks of indirect light are"
! grep -q "disks' radius" caustics.txt || fail "cornell: indirect light among its caustics"
indirect_part() {
    sed -n '/"indirect": {/,/}/p' indirect.json >part-of.json
    value part-of.json "$1"
}
emitted=$(indirect_part "flux emitted") accounted=$(indirect_part "flux accounted")
at_most "($emitted - $accounted) / $emitted" 1e-5 "cornell: the account of indirect light"
# A room has all bounces and a file none, unless one asks.
# shellcheck disable=SC2086
{
    "$caustics" cornell --bounces all $few --output again.pfm >/dev/null
    cmp again.pfm all1.pfm || fail "cornell: not all bounces"
    "$caustics" cornell --bounces 0 $few --output again.pfm --json again.json >/dev/null
    ! cmp again.pfm all1.pfm >/dev/null 2>&1 || fail "cornell: --bounces 0 changes nothing"
    ! grep -q '"indirect"' again.json || fail "cornell: indirect light with --bounces 0"
    "$caustics" box.gltf $few --output file.pfm >/dev/null
    "$caustics" box.gltf --bounces 0 $few --output again.pfm >/dev/null
    cmp file.pfm again.pfm || fail "box.gltf: bounces that nobody asked for"
    "$caustics" box.gltf --bounces 2 $few --output again.pfm --json again.json >/dev/null
    grep -q '"indirect"' again.json || fail "box.gltf: no indirect light with --bounces 2"
}
# Against the truth of the path tracer, for the same eye paths. Its mean is good to 0.3%.
if ! is_sanitized && [ -x "$1/reference_path_tracer" ]; then
    for scene in box cornell table; do
        "$1/reference_path_tracer" $scene --layer indirect --size 24 --samples 768 --output truth.pfm >/dev/null
        "$caustics" $scene --layer indirect --size 24 --reference truth.pfm --output m.pfm --json m.json >/dev/null
        at_most "$(value m.json energy)" 0.04 "$scene: the energy of indirect light"
        at_most "$(value m.json rel)" 0.19 "$scene: indirect light"
    done
fi

# Ctrl-C writes the picture so far, whole, and says so by its status: 128 and the number of SIGINT. Photons so far stand
# for all: the picture is as bright as the finished one.
"$caustics" ring --photons 1e5 --size 64 --output whole.pfm --json whole.json >/dev/null
status=0
seconds=2
! is_sanitized || seconds=30
timeout --preserve-status -s INT $seconds "$caustics" ring --photons 1e12 --size 64 --output part.pfm --json part.json \
    >part.txt 2>errors.txt || status=$?
if [ $status -ne 127 ]; then # there is a timeout
    [ $status -eq 130 ] || fail "Ctrl-C: status $status, $(cat errors.txt)"
    [ "$(wc -l <errors.txt)" -eq 1 ] && grep -q interrupted errors.txt || fail "Ctrl-C: $(cat errors.txt)"
    at_most "$(value part.json energy)" 0.05 "Ctrl-C: energy of the picture so far"
    grep -q '"interrupted": true' part.json || fail "Ctrl-C: the statistics do not say so"
    [ -z "$(ls | grep partial)" ] || fail "Ctrl-C left a part of a file behind"
fi

# What the interrupt left out is said.
status=0
timeout --preserve-status -s INT $seconds "$caustics" cornell --emit 1e12 --size 16 --output part.pfm --json part.json \
    >part.txt 2>errors.txt || status=$?
if [ $status -ne 127 ]; then
    [ $status -eq 130 ] || fail "Ctrl-C in a room: status $status, $(cat errors.txt)"
    grep -q "^note: interrupted before the light between diffuse surfaces" part.txt ||
        fail "Ctrl-C in a room: does not say what is left out: $(cat part.txt)"
fi

# The photons are those of the layer that was asked for.
status=0
timeout --preserve-status -s INT $seconds "$caustics" cornell --layer indirect --emit 1e10 --size 16 --output part.pfm \
    >part.txt 2>errors.txt || status=$?
if [ $status -ne 127 ]; then
    [ $status -eq 130 ] || fail "Ctrl-C in indirect light: status $status, $(cat errors.txt)"
    grep -q "has [1-9][0-9]* photons" errors.txt || fail "Ctrl-C in indirect light: $(cat errors.txt)"
fi

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
refuses "emit" ring --emit 0
for error in 0 -1 100% 2%% nan %; do
    refuses "error" ring --error $error
done
refuses "layers" ring --layers layers.png
refuses "layer direct" cornell --layer direct --error 2%
refuses "error" ring --error ""
refuses "seed" ring --seed -1
refuses "samples" ring --samples 0
refuses "threads" ring --threads -1
refuses "threads" ring --threads 5000
refuses "sequence" ring --sequence fibonacci
refuses "pixel-filter" ring --pixel-filter maybe
refuses "reflections" ring --reflections two
refuses "layer" box.gltf --layer glass
refuses "layer" ring --layer direct
refuses "bands" box.gltf --bands 5
refuses "sun" prism --sun 0,-1,0
refuses "bands" ring --bands 16
refuses "curved" box.gltf --bands 16 --curved
refuses "bands" box.gltf --bands 16 --error 2%
refuses "bands" box.gltf --bands 16 --layer direct
refuses "bounces" ring --bounces 2
refuses "bounces" box --bounces some
refuses "bounces" box --layer direct --bounces 2
refuses "bounces" cornell --layer caustics --bounces all
refuses "bounces" cornell --layer indirect --bounces 0
refuses "smoothing" cornell --layer indirect --smoothing auto
refuses "first-order" cornell --layer direct --first-order
refuses "curved" box.gltf --layer indirect --curved
refuses "kernel" cornell --layer direct --kernel biweight
refuses "specular" box --layer caustics
refuses "specular" box --bounces 0
refuses "view" cornell --view 0 1 0 1
refuses "sun" cornell --sun 0,-1,0
refuses "materials" cornell --fresnel on
refuses "curved" ring --curved --first-order
refuses "view" box.gltf --view 0 1 0 1
refuses "materials" box.gltf --fresnel on
refuses "sun" box.gltf --sun 1,2
refuses "sun" box.gltf --sun 0,0,0
refuses "sun" box.gltf --sun 0,-1,0,120
refuses "sun" box.gltf --sun 0,1,0 --ground
refuses "ground" box.gltf --ground 1.5
refuses "built-in" ring --ground
refuses "no-such.hdr" box.gltf --environment no-such.hdr
refuses "box.gltf" box.gltf --environment box.gltf
printf 'not a picture' >wrong.hdr
refuses "wrong.hdr" box.gltf --environment wrong.hdr
refuses "json" ring --json no-such-folder/json
# What was noticed of a file is said before the fault that ends the program; the fault alone is on stderr.
meshopt='"EXT_meshopt_compression"'
write_box packed.gltf '' ",\"extensionsUsed\":[$meshopt],\"extensionsRequired\":[$meshopt]"
refuses "EXT_meshopt_compression" packed.gltf
write_box faulty.gltf ',"alphaMode":"BLEND"' ',"extensionsUsed":["KHR_materials_clearcoat"],
"cameras":[{"type":"perspective","perspective":{"yfov":9,"znear":1}}]'
sed -i.orig 's/"name":"box"/"name":"box","camera":0/' faulty.gltf
refuses "yfov" faulty.gltf
grep -q "^note: .*KHR_materials_clearcoat" out.txt || fail "did not say what it had noticed: $(cat out.txt)"
status=0
"$caustics" ring --output no-such-folder/x.png >/dev/null 2>errors.txt || status=$?
[ $status -ne 0 ] && grep -q "no-such-folder" errors.txt || fail "wrote into a folder that does not exist"
status=0
"$caustics" ring --output x.jpg >/dev/null 2>errors.txt || status=$?
[ $status -ne 0 ] && grep -q "jpg" errors.txt || fail "wrote a .jpg"

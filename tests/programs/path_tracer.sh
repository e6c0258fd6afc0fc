#!/bin/sh
# SPDX-License-Identifier: MIT
# The program `reference_path_tracer` as its users meet it: pictures of caustics and of rooms, the same bits for any
# number of threads, and what it says of what it cannot do. The argument is the folder of the programs.
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

# A room's picture is three bands; its layers are told apart, and are the same for any number of threads.
for layer in all direct caustics indirect; do
    for threads in 1 3; do
        "$tracer" cornell --layer $layer --size 12 --samples 8 --threads $threads --output $layer$threads.pfm \
            --standard-error se-$layer$threads.pfm >$layer.txt 2>errors.txt || fail "cornell: $(cat errors.txt)"
    done
    cmp ${layer}1.pfm ${layer}3.pfm || fail "cornell, $layer: the picture depends on the number of threads"
    [ "$(head -n 1 ${layer}1.pfm)" = PF ] || fail "cornell: not three bands"
    grep -q "^8 paths an eye path" $layer.txt || fail "does not say how many paths: $(cat $layer.txt)"
done
mean() { # of a picture, as the program says it
    sed -n 's/.*mean radiance \([0-9.]*\),.*/\1/p' "$1"
}
# The same paths make all layers: their sum is the picture, to the six digits that are said.
awk "BEGIN { d = $(mean all.txt) - $(mean direct.txt) - $(mean caustics.txt) - $(mean indirect.txt)
             exit !(d < 3e-6 && d > -3e-6) }" </dev/null || fail "cornell: the layers are not the picture"
"$tracer" box --layer indirect --bounces 0 --size 4 --samples 4 --output none.pfm >none.txt || fail "box"
[ "$(mean none.txt)" = 0.000000 ] || fail "box: indirect light without bounces: $(cat none.txt)"
"$tracer" box --layer indirect --bounces 1 --size 4 --samples 64 --output one.pfm >one.txt || fail "box"
"$tracer" box --layer indirect --size 4 --samples 64 --output many.pfm >many.txt || fail "box"
awk "BEGIN { exit !($(mean one.txt) > 0 && $(mean many.txt) > $(mean one.txt)) }" </dev/null ||
    fail "box: all bounces are not more than one: $(cat one.txt many.txt)"
"$tracer" table --size 16x12 --samples 4 --eye-paths 4 --output table.png >out.txt || fail "table"
[ -s table.png ] || fail "no picture of the table"

# A file: a floor that emits, seen from above. Emission 2 in each band fills the picture, and nothing else is lit.
cat >floor.gltf <<'END'
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
"nodes":[{"mesh":0},{"camera":0,"translation":[0,0,2]}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.5,"aspectRatio":2,"znear":0.1}}],
"materials":[{"emissiveFactor":[1,1,1],"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1],"metallicFactor":0},
"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":2}}}],
"extensionsUsed":["KHR_materials_emissive_strength"],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[-9,-9,0],"max":[9,9,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAQwQAAEMEAAAAAAAAQQQAAEMEAAAAAAAAAAAAAEEEAAAAA"}]}
END
"$tracer" floor.gltf --size 8 --samples 2 --output floor.pfm >out.txt 2>errors.txt || fail "a file: $(cat errors.txt)"
[ "$(head -n 2 floor.pfm | tail -n 1)" = "8 4" ] || fail "a file's camera does not choose the height: $(cat out.txt)"
[ "$(mean out.txt)" = 2.000000 ] || fail "a file: $(cat out.txt)"

# A refusal is one line on stderr, a status that is not zero, and no file.
refuses() { # words in the message, arguments
    words=$1
    shift
    rm -f refused.pfm
    must_refuse 2 "$words" "$tracer" "$@" --output refused.pfm
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
refuses "bounces" ring-disk --bounces 2
refuses "bounces" box --bounces some
refuses "bounces" box --bounces -1
refuses "bounces" box --layer direct --bounces 2
refuses "bounces" cornell --layer caustics --bounces all
refuses "samples" box --samples 1
refuses "samples" floor.gltf --samples 1
refuses "layer" ring-disk --layer indirect
refuses "layer" box --layer glass
refuses "eye-paths" box --eye-paths 0
refuses "reflections" box --reflections one
"$tracer" ring-disk --bounces 0 --size ${columns}x$rows --samples 64 --output mean0.pfm >out.txt || fail "--bounces 0"
cmp mean0.pfm mean1.pfm || fail "--bounces 0 changes the picture of a caustic"
status=0
"$tracer" ring-disk --output x.jpg >/dev/null 2>errors.txt || status=$?
[ $status -eq 1 ] && grep -q "jpg" errors.txt || fail "wrote a .jpg"
for file in no-such.glb empty.gltf; do
    printf '{"asset":{"version":"2.0"}}' >empty.gltf
    status=0
    "$tracer" $file --output refused.pfm >/dev/null 2>errors.txt || status=$?
    [ $status -eq 1 ] && [ "$(wc -l <errors.txt)" -eq 1 ] && grep -q "$file" errors.txt || fail "$file: $(cat errors.txt)"
done

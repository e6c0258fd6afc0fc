#!/bin/sh
# SPDX-License-Identifier: MIT
# What each feature costs where it is used, and that it costs nothing where it is not: features.cpp, compiled with one feature
# at a time. Prints bytes per photon, instructions per photon (of g++ -O2, as valgrind counts them), and compile time.
# The first argument, the programs' folder, is not looked at; `all` as the second measures every feature, which takes a
# minute, and else it is those that the others are like. CXX is the compiler.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
cxx=${CXX:-g++}
command -v valgrind >/dev/null && command -v "$cxx" >/dev/null && command -v nm >/dev/null || exit 77
[ -e "/usr/include/glm/vec3.hpp" ] || [ -n "${CPATH:-}" ] || exit 77
. "$(dirname "$0")/shared"
! is_sanitized || exit 77 # it compiles for itself, so there is nothing new to see
flags="-std=c++20 -DNDEBUG -I$root/include"

# Sets bytes, deposited_bytes, emission, walk (instructions) and seconds of a variant.
measure() { # its macro, or -DNONE
    times >before.txt
    "$cxx" $flags -O2 "$1" "$root/tests/programs/features.cpp" -o variant -pthread || fail "$1 does not compile"
    times >after.txt
    seconds=$(awk -F '[ms ]+' 'FNR == 2 { t = 60 * $1 + $2 - t } END { print t }' before.txt after.txt)
    valgrind --tool=callgrind --callgrind-out-file=calls.txt ./variant >numbers.txt 2>errors.txt || fail "$1: $(cat errors.txt)"
    read -r bytes deposited_bytes deposits <numbers.txt
    [ "$deposits" -eq 1000 ] || fail "$1: $deposits of 1000 photons arrive"
    callgrind_annotate --inclusive=yes --threshold=100 calls.txt | tr -d , >functions.txt
    emission=$(awk '/:emit_one/ { print $1 / 1000; exit }' functions.txt)
    walk=$(awk '/:walk_one/ { print $1 / 1000; exit }' functions.txt)
    [ -n "$emission" ] && [ -n "$walk" ] || fail "$1: valgrind has not seen it"
}

all=${2:-}
row() { # what it is called, macro
    measure "$2"
    printf '%-44s %5d %8d %9.0f %6.0f %11.1f\n' "$1" "$bytes" "$deposited_bytes" "$emission" "$walk" "$seconds"
}

printf '%-44s %5s %8s %9s %6s %11s\n' "" "bytes" "" "instructions" "" "seconds to"
printf '%-44s %5s %8s %9s %6s %11s\n' "feature" "photon" "deposit" "emission" "walk" "compile"
row "planar mirror, directional light, float" -DNONE
base_bytes=$bytes base_walk=$walk base_emission=$emission

dearer() { # row's name, macro, and whether only `all` wants it
    [ "$all" = all ] || [ -z "${3:-}" ] || return 0
    row "$1" "$2"
    awk "BEGIN { exit !($walk > $base_walk) }" || fail "$1: it costs nothing, so what is measured?"
}
row "  no tangents (fixed radius, k-NN)" -DWITHOUT_TANGENTS
awk "BEGIN { exit !($walk < $base_walk && $bytes < $base_bytes) }" || fail "tangents that are left out are paid for"
dearer "  shading normals" -DSHADING_NORMAL only
dearer "  curvature: shape operator" -DSHAPE_OPERATOR only
dearer "  curvature: dpdu, dpdv, dndu, dndv" -DPARAMETRIC only
dearer "  curvature: interpolated normals" -DINTERPOLATED only
dearer "  curvature: any of three" -DANY_CURVATURE
dearer "  curvature: finite differences" -DFINITE_DIFFERENCES
dearer "  glass" -DGLASS
dearer "  glass, with a tangent by wavelength" -DWAVELENGTH only
dearer "  absorbing media" -DMEDIUM only
dearer "  RGB flux" -DRGB only
dearer "  16 bands of flux" -DBANDS
[ "$all" != all ] || row "  point light" -DPOINT_LIGHT
row "  area light" -DAREA_LIGHT
awk "BEGIN { exit !($emission > $base_emission) }" || fail "an area light's tangents cost nothing; what is then measured?"
[ "$all" != all ] || row "  any of seven kinds of light" -DALL_LIGHTS
[ "$all" != all ] || row "  double" -DDOUBLE

# What the plain scene does not use is not in it: without inlining every function would have a symbol.
"$cxx" $flags -O0 -fno-inline -DNONE -c "$root/tests/programs/features.cpp" -o plain.o
nm --demangle plain.o >symbols.txt
grep -q 'nephroid::Flat::operator()' symbols.txt || fail "no symbols"
for unused in Refraction ShapeOperator ParametricCurvature InterpolatedCurvature AnyCurvature FiniteDifference reemit AreaEmission \
    QuadLight PointLight LightSet WithoutTangents ParametricScene Wavelength; do
    ! grep -q "$unused" symbols.txt || fail "$unused is compiled though nothing uses it"
done

# Nor is what chooses footprints for other kinds of lights in a program that has a sun alone.
"$cxx" $flags -O0 -fno-inline -c "$root/examples/drop_in.cpp" -o sun.o
nm --demangle sun.o >symbols.txt
grep -q 'nephroid::detail::GroupField::' symbols.txt || fail "no symbols of the sun's footprints"
for unused in AreaField:: AreaFit:: AreaCells:: smoothing_without_cells; do
    ! grep -q "nephroid::.*$unused" symbols.txt || fail "$unused is compiled for a sun"
done

# Nor anything of second order in one that calls the published method.
sed 's#nephroid::caustics(#nephroid::splat_caustics(#; s#nephroid/caustics.hpp#nephroid/splat/splat_caustics.hpp#' "$root/examples/drop_in.cpp" >published.cpp
"$cxx" $flags -MMD -MF published.d -O0 -fno-inline -c published.cpp -o published.o
! grep -q 'nephroid/smoothing/' published.d || fail "the published method includes second order"

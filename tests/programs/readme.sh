#!/bin/sh
# SPDX-License-Identifier: MIT
# The README's first block of code is the program examples/drop_in.cpp, and that one runs and draws a picture.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
. "$(dirname "$0")/shared"
sed -n '/^```cpp$/,/^```$/p' "$root/README.md" | sed '1d; /^```$/,$d' >readme.cpp
# The program opens with its licence and purpose, which the README leaves out.
tail -n +3 "$root/examples/drop_in.cpp" | diff - readme.cpp

[ -x "$1/drop_in" ] || exit 77
"$1/drop_in"
[ "$(wc -c <caustic.pgm)" -gt 262144 ]

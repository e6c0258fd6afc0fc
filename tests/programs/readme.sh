#!/bin/sh
# SPDX-License-Identifier: MIT
# The code on the front page is a part of examples/drop_in.cpp, and that program runs and draws a picture.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
. "$(dirname "$0")/shared"
sed -n '/^```cpp$/,/^```$/p' "$root/README.md" | sed '/^```/d' >readme.cpp
[ -s readme.cpp ] || fail "no code on the front page"
case "$(cat "$root/examples/drop_in.cpp")" in
*"$(cat readme.cpp)"*) ;;
*) fail "the code on the front page is not in examples/drop_in.cpp" ;;
esac

[ -x "$1/drop_in" ] || exit 77
"$1/drop_in"
[ "$(wc -c <caustic.pgm)" -gt 262144 ]

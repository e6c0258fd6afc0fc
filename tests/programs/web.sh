#!/bin/sh
# SPDX-License-Identifier: MIT
# The page of examples/web: what the library draws in WebAssembly is what it draws here, with each method and in each
# scene, in node and in a browser; and in a headless Chromium the page loads, draws, follows a drag, and fits a phone.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
programs=$1
skip() {
    echo "Skipped: $*"
    exit 77
}
[ -x "$programs/web/web_caustic_map" ] || skip "web_caustic_map was not built"
[ -e "$programs/web/caustic_map.js" ] || skip "the page was not built, em++ is missing (Debian: emscripten)"
node=$(command -v node) || skip "node is missing (Debian: nodejs)"
. "$(dirname "$0")/shared"
! is_sanitized || skip "the page has no sanitizers"

"$node" --no-experimental-fetch "$root/tests/programs/web_node.js" "$programs" || fail "node"
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || {
    echo "The page was not looked at, Chromium is missing (Debian: chromium)"
    exit 0
}
"$node" "$root/tests/programs/web_browser.js" "$chromium" "$programs/web" "${NEPHROID_SCREENSHOTS:-$PWD}" ||
    fail "the page in $chromium"

#!/bin/sh
# SPDX-License-Identifier: MIT
# What tests/install-packages does on systems unlike this one, which are made of a few commands here: no commands but these
# are found. Nothing is installed. The argument, the programs' folder, is not looked at.
set -eu
install_packages=$(cd "$(dirname "$0")/.." && pwd)/install-packages
# shellcheck source-path=SCRIPTDIR
. "$(dirname "$0")/shared"

mkdir commands
for command in sh env; do
    ln -s "$(command -v $command)" commands/
done
stands_for() { # command: what it does, as a line of the shell
    printf '#!/bin/sh\n%s\n' "$2" >"commands/$1"
    chmod +x "commands/$1"
}
install() { # prints what it says
    rm -f calls
    PATH="$scratch/commands" sh "$install_packages" "$@" 2>&1 || fail "returned $?, though it may go on without packages"
}
list="cmake g++ ninja-build pkg-config libglm-dev libnanoflann-dev doctest-dev libcli11-dev libopenexr-dev libstb-dev"
list="$list libtinygltf-dev"

# Another system than Debian.
install meson >said
grep -qx "Not checked, or not installed, by the names that Debian gives them: $list meson" said || fail "$(cat said)"

# A user who is not root, without sudo: the line to type, as it is to be typed.
stands_for dpkg-query 'case $* in *cmake*|*meson*) printf installed ;; *) exit 1 ;; esac'
stands_for apt-get "echo apt-get \"\$@\" >>'$scratch/calls'"
stands_for apt-cache 'case $* in *stb*) exit 100 ;; esac'
stands_for id 'echo 1000'
install meson >said
grep -qx "  apt-get update && apt-get install --no-install-recommends ${list#cmake }" said || fail "no line to type: $(cat said)"
[ ! -e calls ] || fail "without root: $(cat calls)"

# With sudo. What this release does not have is named, and the others are installed.
stands_for sudo "echo as root >>'$scratch/calls'; exec \"\$@\""
install >said
grep -qx 'Not in this release: libstb-dev' said || fail "$(cat said)"
grep -q "^apt-get .* install --yes --no-install-recommends g++ .* libopenexr-dev libtinygltf-dev\$" calls || fail "$(cat calls)"
[ "$(grep -cx 'as root' calls)" = 2 ] || fail "updates and installs as root: $(cat calls)"

# Where installing fails it says so.
stands_for apt-get 'exit 100'
install >said
grep -q '^Not installed: g++ ' said || fail "$(cat said)"

# Where nothing is missing it says nothing.
stands_for dpkg-query 'printf installed'
install >said
[ ! -s said ] || fail "nothing is missing: $(cat said)"

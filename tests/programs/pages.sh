#!/bin/sh
# SPDX-License-Identifier: MIT
# The pages hold together: what they link to exists, and they can be read. The front page has at most 250 lines and reaches
# its first line of code by line 25. The argument, the programs' folder, is not looked at.
set -eu
cd "$(dirname "$0")/../.."
pages="README.md examples/README.md tests/README.md include/nephroid/README.md .github/CONTRIBUTING.md .github/CHANGELOG.md"
failed=0
complain() {
    echo "$*" >&2
    failed=1
}

# The headings of a page, as its links name them: small letters, blanks as hyphens, no other signs.
anchors() {
    sed -n '/^```/,/^```/d; s/^##* //p' "$1" | tr '[:upper:] ' '[:lower:]-' | tr -cd 'a-z0-9\n_-'
}

for page in $pages; do
    folder=$(dirname "$page")
    for link in $(sed '/^```/,/^```/d' "$page" | grep -o '](\([^)]*\))' | sed 's/^](//; s/)$//'); do
        case $link in
        http*) continue ;;
        esac
        file=${link%%#*}
        target=$page
        [ -z "$file" ] || target=$folder/$file
        [ -e "$target" ] || complain "$page: $link does not exist"
        case $link in
        *#*) anchors "$target" | grep -qx -- "${link#*#}" || complain "$page: $link is no heading" ;;
        esac
    done

    # Tables and the marks around them may be wider.
    wide=$(LC_ALL=C.UTF-8 grep -nE '^.{121,}' "$page" | grep -vE '^[0-9]+:(\||<!--)' | cut -d : -f 1 | tr '\n' ' ') || true
    [ -z "$wide" ] || complain "$page: more than 120 columns in line(s) $wide"

    # What is opened is closed: blocks of code, and tables between their marks.
    [ $(($(grep -c '^```' "$page") % 2)) -eq 0 ] || complain "$page: a block of code is not closed"
    opened=$(sed -n 's/^<!-- table \([^:]*\): .* -->$/\1/p' "$page")
    closed=$(sed -n 's/^<!-- end \(.*\) -->$/\1/p' "$page")
    [ "$opened" = "$closed" ] || complain "$page: a table's marks do not match"
done

[ "$(wc -l <README.md)" -le 250 ] || complain "README.md has more than 250 lines"
[ "$(grep -n -m 1 '^```cpp$' README.md | cut -d : -f 1)" -lt 25 ] || complain "README.md: the first code comes after line 25"
exit $failed

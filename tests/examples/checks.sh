# For the tests of programs, which source it: a folder of their own to work in, and a count of what fails.
# shellcheck shell=bash

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failures=0

# fail LINE...: what $what says did not do what it should.
fail() {
    failures=$((failures + 1))
    echo "FAILED: $what"
    printf '    %s\n' "$@"
}

# The last line of a test: its exit status.
end_checks() {
    [ "$failures" -eq 0 ] || { echo "$failures checks failed"; exit 1; }
    echo "all as expected"
}

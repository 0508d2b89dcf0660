#!/usr/bin/env bash
# Callables that `Accept` and `Executor` do not keep are refused by the compiler, which says what to do: each of the lines
# marked below, and nothing else. Usage: callables_refused.sh COMPILER FLAGS...
set -euo pipefail

file=$(mktemp --suffix=.cpp)
trap 'rm -f "$file"' EXIT
cat >"$file" <<'CODE'
#include <functional>
#include <string>
#include <pierce/pierce.h>
using namespace pierce;
struct Five {
    void* room[5] = {};
    bool operator()(const Contact&) const { return false; }
    void operator()(std::size_t, Task) const {}
};
void ask(const CollisionMesh<double>& mesh, const Segment<double>& segment, std::string name, int count) {
    QueryOptions options;
#ifdef BAD
    options.accept = Five();
    options.accept = [name](const Contact& contact) { return contact.face == name.size(); };
    options.accept = [count](const Contact&) mutable { return ++count > 1; };
    options.accept = std::function<bool(const Contact&)>([](const Contact&) { return true; });
    const Executor large = Five();
    const Executor owner = [name](std::size_t, Task) {};
    std::ignore = mesh.first_hit(segment, {.accept = Five()});
#endif
    const Five five;
    options.accept = std::ref(five);
    options.accept = [count](const Contact&) { return count > 1; };
    std::ignore = mesh.first_hit(segment, options);
}
CODE
"$@" -std=c++20 -fsyntax-only "$file"
output=$("$@" -std=c++20 -fsyntax-only -DBAD "$file" 2>&1) && { echo "all of them are taken"; exit 1; }
said=$(grep -cE 'error: (static assertion failed|static_assert failed).*wrap it in std::ref' <<<"$output") || true
# One for each kind of callable and keeper: the two uses of Five by Accept are one.
[ "$said" -eq 6 ] || { echo "$output"; echo "says so $said times, not 6"; exit 1; }

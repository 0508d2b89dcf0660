#!/usr/bin/env bash
# Every block of C++ in the guide and in README.md compiles: one with includes stands by itself, others are statements
# about a mesh, a particle and the like. So do the statements in the comments of public headers, which the site shows.
# Usage: guide_test.sh COMPILER INCLUDE_FLAGS...
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

{
    cat <<'CODE'
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <optional>
#include <span>
#include <vector>

#include <pierce/kernels.h>
#include <pierce/pierce.h>
#include <pierce/pierce_c.h>
#include <pierce/tbb.h>

struct Vertex {
    float x, y, z;
    float u, v;
};
CODE
    for page in "$root"/README.md "$root"/examples/guide/*.md; do
        awk -v page="${page#"$root"/}" '
            function flush_block() {
                # What has an include or a function of its own stands by itself; two programs are two namespaces.
                ++count
                name = page; gsub(/[^a-zA-Z0-9]/, "_", name)
                sub(/int main\(\) {/, "int program() {", text)
                if (text ~ /int program/) sub(/}\n$/, "    return 0;\n}\n", text)
                if (own) { printf "%snamespace %s_%d {\n#line %d \"%s\"\n%s}\n", includes, name, count, first, page, text }
                else printf "void %s_%d([[maybe_unused]] const pierce::CollisionMesh<float>& mesh, [[maybe_unused]] std::vector<Vertex>& vertices, [[maybe_unused]] std::vector<std::uint16_t>& indices, [[maybe_unused]] std::vector<Eigen::Vector3f>& starts, [[maybe_unused]] std::vector<Eigen::Vector3f>& ends, [[maybe_unused]] Eigen::Vector3f& position, [[maybe_unused]] Eigen::Vector3f& velocity, [[maybe_unused]] Eigen::Vector3f& target, [[maybe_unused]] float seconds) {{\n#line %d \"%s\"\n%s}}\n", name, count, first, page, text
            }
            /^```cpp$/ { inside = 1; text = includes = ""; own = 0; first = NR + 1; next }
            /^```$/ { if (inside) flush_block(); inside = 0; next }
            inside && /^#include/ { own = 1; includes = includes $0 "\n"; text = text "\n"; next }
            inside { text = text $0 "\n" }' "$page"
    done
    cat <<'CODE'

struct InComments {  // what the blocks there speak of
    pierce::CollisionMesh<double> mesh;
    pierce::Segment<double> segment;
    Eigen::Vector3d a, b, c, from, to, point, direction, particle;
    double distance;
    std::uint32_t region, still;
    const pierce::Regions<double>& regions;
    bool (*is_mirror)(std::uint32_t);
    std::vector<Eigen::Vector3f> positions;
    std::vector<pierce::IndexTriple> triangles;
    std::vector<Vertex> vertices;
    std::vector<std::uint16_t> indices;
    template <int> int block();
};
struct InWorlds {
    using Vec3 = Eigen::Vector3f;
    pierce::World<float> world;
    pierce::MeshId id;
    pierce::DeformingMesh<float> deforming;
    pierce::DeformationStep<float> step;
    Vec3 at, to;
    std::uint32_t still;
    template <int> int block();
};
struct InC {
    double corners[12], from[3], to[3], particle[3];
    std::uint32_t indices[6];
    template <int> int block();
};
using namespace pierce;
CODE
    count=0
    for header in "$root"/include/pierce/*.h; do
        count=$((count + 1))
        awk -v number="$count" -v header="${header#"$root"/}" '
            function flush_block() {
                # Formulas have no semicolon. An empty body at the end is for a block that is the head of an `if`.
                if (text ~ /;/) {
                    about = header ~ /world.h/ ? "InWorlds" : header ~ /_c.h/ ? "InC" : "InComments"
                    printf "template <> int %s::block<%d>() {\n#line %d \"%s\"\n%s{}\nreturn 0;\n}\n", about, 1000 * number + first, first, header, text
                }
                text = ""
            }
            /^ *\/\/\/?     / && (text != "" || blank) { if (text == "") first = NR; line = $0; sub(/^ *\/\/\/?/, "", line); text = text line "\n"; next }
            { flush_block(); blank = /^ *\/\/\/?$/ }' "$header"
    done
} >"$folder/guide.cpp"
blocks=$(grep -c '^#line' "$folder/guide.cpp")
[ "$blocks" -gt 35 ] || { echo "only $blocks blocks of C++ were found"; exit 1; }
"$@" -std=c++20 -fsyntax-only -Wall -Wextra -Wno-unused-variable -Wno-unused-but-set-variable \
    -Wno-missing-field-initializers -Werror -I"$root/include" "$folder/guide.cpp"
echo "$blocks blocks compile"

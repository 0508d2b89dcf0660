// PLY's triangle strips, in which the Stanford 3D scanning repository has its meshes: one row of indices with -1
// between the strips. They were refused.
#include "read_test_support.h"

namespace pierce {
namespace {

using test::put;
using test::read;
using test::refusal;

using Triangles = std::vector<IndexTriple>;

const std::string k_vertices = "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n";
const std::string k_positions = "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n";
constexpr const char* k_strips = "element tristrips 1\nproperty list int int vertex_indices\n";

std::string with_strips(const std::string& rows, const std::string& elements = k_strips) {
    return "ply\nformat ascii 1.0\n" + k_vertices + elements + "end_header\n" + k_positions + rows;
}

TEST(ReadPlyStrips, TurnsEveryOtherTriangleRound) {
    // 1--3--5
    // |\ |\ |     All face the same way: each inner edge is passed once forth and once back.
    // 0--2--4
    const auto mesh = read("ply", with_strips("6 0 2 1 3 5 4\n"));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 2, 1}, {1, 2, 3}, {1, 3, 5}, {5, 3, 4}}));
    EXPECT_TRUE(mesh.faces.empty());
}

TEST(ReadPlyStrips, StartsAgainBehindMinusOne) {
    const Triangles expected = {{0, 2, 1}, {1, 2, 3}, {3, 2, 4}, {3, 4, 5}};
    // The third strip starts a new turn: were the corners counted through, it would face the other way.
    EXPECT_EQ(read("ply", with_strips("12 0 2 1 3 -1 3 2 4 -1 3 4 5\n")).triangles, expected);
    EXPECT_EQ(read("ply", with_strips("16 -1 0 2 1 3 -1 -1 3 2 4 -1 3 4 5 -1 -1\n")).triangles, expected)
        << "nothing between two -1 is nothing";
    EXPECT_EQ(read("ply", with_strips("4 0 2 1 3\n0\n7 3 2 4 -1 3 4 5\n",
                                      "element tristrips 3\nproperty list int int vertex_index\n"))
                  .triangles,
              expected)
        << "the end of a row ends a strip";
}

TEST(ReadPlyStrips, KeepsTheJointsAsFacesOfZeroArea) {
    // The second and the third repeat corner 1. A face that is left out would give all behind it other numbers.
    EXPECT_EQ(read("ply", with_strips("7 0 2 1 1 3 4 5\n")).triangles,
              (Triangles{{0, 2, 1}, {1, 2, 1}, {1, 1, 3}, {3, 1, 4}, {3, 4, 5}}));
}

TEST(ReadPlyStrips, StandBesideFacesInTheOrderOfTheFile) {
    const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
    const auto behind = read("ply", with_strips("4 0 2 3 1\n4 2 4 3 5\n", face + k_strips));
    EXPECT_EQ(behind.triangles, (Triangles{{0, 2, 3}, {0, 3, 1}, {2, 4, 3}, {3, 4, 5}}));
    EXPECT_EQ(behind.faces, (std::vector<std::uint32_t>{0, 0, 1, 2}));
    const auto before = read("ply", with_strips("4 2 4 3 5\n4 0 2 3 1\n", k_strips + face));
    EXPECT_EQ(before.faces, (std::vector<std::uint32_t>{0, 1, 2, 2}));
    const auto none = read("ply", with_strips("4 2 4 3 5\n", std::string("element face 0\n") + k_strips));
    EXPECT_EQ(none.triangles.size(), 2U) << "an empty element needs no list of corners";
}

TEST(ReadPlyStrips, ReadsEveryTypeOfCorner) {
    const auto file = [](const std::string& types, std::endian order, auto length, auto corner) {
        std::string bytes = std::string("ply\nformat binary_") + (order == std::endian::big ? "big" : "little") +
                            "_endian 1.0\nelement tristrips 1\nproperty list " + types +
                            " vertex_indices\nelement vertex 3\nproperty char x\nproperty char y\nproperty char z\n"
                            "end_header\n";
        put(bytes, static_cast<decltype(length)>(8), order);
        for (const int i : {2, 1, 0, -1, 0, 1, 2, -1}) {
            put(bytes, static_cast<decltype(corner)>(i), order);
        }
        return bytes + std::string(9, '\1');
    };
    const Triangles expected = {{2, 1, 0}, {0, 1, 2}};
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        EXPECT_EQ(read("ply", file("int int", order, std::int32_t{}, std::int32_t{})).triangles, expected);
        EXPECT_EQ(read("ply", file("uint short", order, std::uint32_t{}, std::int16_t{})).triangles, expected);
        EXPECT_EQ(read("ply", file("uchar char", order, std::uint8_t{}, std::int8_t{})).triangles, expected);
    }
    // Without a sign there is no -1.
    const std::string bytes = file("uchar uchar", std::endian::little, std::uint8_t{}, std::uint8_t{});
    EXPECT_EQ(refusal("ply", bytes), ": byte " + std::to_string(bytes.find("end_header\n") + 11 + 4) +
                                         ": face 1: vertex index 255 is out of range (3 vertices, counted from 0)");
}

TEST(ReadPlyStrips, RefusesStripsThatAreWrong) {
    const auto rows = [](const std::string& text) { return refusal("ply", with_strips(text)); };
    EXPECT_EQ(rows("4 0 2 1 6\n"), ":16: face 1: vertex index 6 is out of range (6 vertices, counted from 0)");
    EXPECT_EQ(rows("8 0 2 1 3 -1 3 2 -2\n"),
              ":16: face 2: vertex index -2 is out of range (6 vertices, counted from 0)");
    EXPECT_EQ(rows("6 0 2 1 -1 3 2\n"), ":16: the strip has 2 corners: at least 3 are needed");
    EXPECT_EQ(rows("6 0 -1 2 1 3 4\n"), ":16: the strip has 1 corner: at least 3 are needed");
    EXPECT_EQ(rows("5 0 2 1 3\n"), ":16: the line ends before its last property");
    EXPECT_EQ(rows("4 0 2 1 3 4\n"), ":16: the line goes on behind its last property");
    EXPECT_EQ(rows("2 -1 -1\n"), ": holds no face");
    EXPECT_EQ(rows("4000000000 0 2 1\n"), ":16: the line ends before its last property");
    const auto header = [](const std::string& elements) {
        return refusal("ply", with_strips("4 0 1 2 3\n", elements));
    };
    EXPECT_EQ(header("element tristrips 1\nproperty list int int strips\n"),
              ":7: element 'tristrips' has no list 'vertex_indices'");
    EXPECT_EQ(header("element tristrips 1\nproperty list int float vertex_indices\n"),
              ":8: corners can't be floating-point numbers");
    EXPECT_EQ(header("element tristrips 0\nproperty list int int vertex_indices\n"), ": holds no face");
    EXPECT_EQ(refusal("ply", "ply\nformat ascii 1.0\n" + std::string(k_strips) + "end_header\n3 0 1 2\n"),
              ":3: there are faces, but no element 'vertex'");
}

}  // namespace
}  // namespace pierce

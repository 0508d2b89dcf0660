// PLY: text and both byte orders, any layout of the rows, and each refusal.
#include "read_test_support.h"

#include <limits>

namespace pierce {
namespace {

using test::binary_ply;
using test::put;
using test::read;
using test::refusal;

const std::string k_vertex = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string k_face = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string k_rows = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string text_ply(const std::string& elements, const std::string& rows) {
    return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + rows;
}

/// A triangle of three vertices on one line, whose x has the given type and, in the last vertex, the given value.
template <class Number>
std::string with_last_x(const std::string& type, Number x, std::endian order = std::endian::little) {
    std::string bytes = "ply\nformat binary_" + std::string(order == std::endian::big ? "big" : "little") +
                        "_endian 1.0\nelement vertex 3\nproperty " + type + " x\nproperty uchar y\nproperty uchar z\n" +
                        k_face + "end_header\n";
    for (int i = 0; i < 3; ++i) {
        put(bytes, i == 2 ? x : Number(i), order);
        put(bytes, std::uint8_t{0});
        put(bytes, std::uint8_t{0});
    }
    put(bytes, std::uint8_t{3});
    for (const std::int32_t corner : {0, 1, 2}) {
        put(bytes, corner, order);
    }
    return bytes;
}

TEST(ReadPly, ReadsText) {
    const auto mesh = read("ply", text_ply(k_vertex + k_face, "0 0.5 -1\n1 2 3\n\n4 5 6\n3 2 1 0"));
    ASSERT_EQ(mesh.positions.size(), 3U);
    EXPECT_EQ(mesh.positions[0], Vec3<double>(0, 0.5, -1));
    EXPECT_EQ(mesh.triangles, (std::vector<IndexTriple>{{2, 1, 0}}));
    EXPECT_TRUE(mesh.faces.empty());
}

TEST(ReadPly, ReadsTextAtFullPrecisionWhateverTypeIsDeclared) {
    EXPECT_EQ(read("ply", text_ply(k_vertex + k_face, "0.1 0 0\n1 2 3\n4 5 6\n3 2 1 0\n")).positions[0][0], 0.1);
}

TEST(ReadPly, ReadsBothByteOrdersAndPassesOverTheRest) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        const auto mesh = read("ply", binary_ply(order));
        ASSERT_EQ(mesh.positions.size(), 5U);
        EXPECT_EQ(mesh.positions[1], Vec3<double>(1.5, 0, 0.1)) << "z is a double";
        EXPECT_EQ(mesh.positions[2], Vec3<double>(1.5, 2, 0));
        EXPECT_EQ(mesh.positions[4], Vec3<double>(0, 0, -3));
        ASSERT_EQ(mesh.triangles.size(), 4U);
        EXPECT_EQ(mesh.triangles[0], (IndexTriple{0, 1, 4}));
        EXPECT_EQ(mesh.triangles[3], (IndexTriple{1, 2, 4}));
        EXPECT_EQ(mesh.faces, (std::vector<std::uint32_t>{0, 1, 1, 2}));
    }
}

TEST(ReadPly, PassesOverOtherPropertiesInText) {
    const auto mesh =
        read("ply", text_ply("comment a b c\nobj_info none\nelement material 1\nproperty list uchar float values\n"
                             "element vertex 3\nproperty uchar red\nproperty float y\nproperty list int int marks\n"
                             "property double x\nproperty int z\nelement face 1\nproperty uchar flag\n"
                             "property list uint8 uint32 vertex_index\nproperty list uchar float texcoord\n",
                             "2 nan 1e999\n9 1 0 2 3\n9 4 2 7 7 5 6\n9 7 1 7 8 9\n0 3 0 1 2 6 0 0 1 0 1 1\n"));
    EXPECT_EQ(mesh.positions[1], Vec3<double>(5, 4, 6));
    EXPECT_EQ(mesh.triangles, (std::vector<IndexTriple>{{0, 1, 2}}));
}

TEST(ReadPly, TakesEveryTypeOfCoordinate) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        const auto last_x = [order](const std::string& type, auto x) {
            return read("ply", with_last_x(type, x, order)).positions[2][0];
        };
        for (const char* prefix : {"", "32"}) {
            const std::string name = std::string("float") + prefix;
            EXPECT_EQ(last_x(name, -1.5F), -1.5);
        }
        EXPECT_EQ(last_x("double", 0.1), 0.1);
        EXPECT_EQ(last_x("float64", 5e-324), 5e-324);
        EXPECT_EQ(last_x("char", std::int8_t{-128}), -128);
        EXPECT_EQ(last_x("int8", std::int8_t{-1}), -1);
        EXPECT_EQ(last_x("uchar", std::uint8_t{255}), 255);
        EXPECT_EQ(last_x("uint8", std::uint8_t{128}), 128);
        EXPECT_EQ(last_x("short", std::int16_t{-32768}), -32768);
        EXPECT_EQ(last_x("int16", std::int16_t{258}), 258);
        EXPECT_EQ(last_x("ushort", std::uint16_t{65535}), 65535);
        EXPECT_EQ(last_x("uint16", std::uint16_t{258}), 258);
        EXPECT_EQ(last_x("int", std::int32_t{-2147483647 - 1}), -2147483648.0);
        EXPECT_EQ(last_x("int32", std::int32_t{66051}), 66051);
        EXPECT_EQ(last_x("uint", std::uint32_t{4294967295U}), 4294967295.0);
        EXPECT_EQ(last_x("uint32", std::uint32_t{66051}), 66051);
    }
}

TEST(ReadPly, RoundsToFloatOnceAndRefusesWhatDoesNotFit) {
    EXPECT_EQ(read<float>("ply", with_last_x("double", 0.1)).positions[2][0], 0.1F);
    EXPECT_EQ(read<float>("ply", with_last_x("uint", 16777219U)).positions[2][0], 16777220.0F);
    const double infinity = std::numeric_limits<double>::infinity();
    // The three vertices start where the header ends, 10 bytes each.
    const auto at = [](const std::string& file) {
        return ": byte " + std::to_string(file.find("end_header\n") + 11 + 20);
    };
    const std::string huge = with_last_x("double", -1e39);
    EXPECT_EQ(refusal<float>("ply", huge), at(huge) + ": coordinate -1e+39 does not fit in float");
    EXPECT_EQ(refusal<double>("ply", huge), "read");
    const std::string nan = with_last_x("double", std::nan(""), std::endian::big);
    EXPECT_EQ(refusal("ply", nan), at(nan) + ": a coordinate is not a number (NaN)");
    const std::string endless = with_last_x("double", -infinity);
    EXPECT_EQ(refusal("ply", endless), at(endless) + ": a coordinate is infinite");
}

TEST(ReadPly, TakesEveryTypeOfCorner) {
    const auto file = [](const std::string& types, auto length, auto corner) {
        std::string bytes =
            "ply\nformat binary_big_endian 1.0\nelement face 1\nproperty list " + types +
            " vertex_indices\nelement vertex 3\nproperty char x\nproperty char y\nproperty char z\nend_header\n";
        put(bytes, length, std::endian::big);
        for (int i = 0; i < 3; ++i) {
            put(bytes, static_cast<decltype(corner)>(corner - static_cast<decltype(corner)>(i)), std::endian::big);
        }
        return bytes + std::string(9, '\1');
    };
    const std::vector<IndexTriple> expected = {{2, 1, 0}};
    EXPECT_EQ(read("ply", file("char char", std::int8_t{3}, std::int8_t{2})).triangles, expected);
    EXPECT_EQ(read("ply", file("uint8 uint8", std::uint8_t{3}, std::uint8_t{2})).triangles, expected);
    EXPECT_EQ(read("ply", file("short short", std::int16_t{3}, std::int16_t{2})).triangles, expected);
    EXPECT_EQ(read("ply", file("ushort ushort", std::uint16_t{3}, std::uint16_t{2})).triangles, expected);
    EXPECT_EQ(read("ply", file("int int", std::int32_t{3}, std::int32_t{2})).triangles, expected);
    EXPECT_EQ(read("ply", file("uint uint", std::uint32_t{3}, std::uint32_t{2})).triangles, expected);
    const auto start = [](const std::string& bytes) { return bytes.find("end_header\n") + 11; };
    std::string bytes = file("uchar int", std::uint8_t{3}, std::int32_t{1});
    EXPECT_EQ(refusal("ply", bytes), ": byte " + std::to_string(start(bytes) + 9) +
                                         ": face 0: vertex index -1 is out of range (3 vertices, counted from 0)");
    bytes = file("uchar uint", std::uint8_t{3}, std::uint32_t{3});
    EXPECT_EQ(refusal("ply", bytes), ": byte " + std::to_string(start(bytes) + 1) +
                                         ": face 0: vertex index 3 is out of range (3 vertices, counted from 0)");
    bytes = file("char int", std::int8_t{-1}, std::int32_t{2});
    EXPECT_EQ(refusal("ply", bytes), ": byte " + std::to_string(start(bytes)) + ": a list can't have -1 numbers");
    bytes = file("uchar int", std::uint8_t{2}, std::int32_t{2});
    EXPECT_EQ(refusal("ply", bytes),
              ": byte " + std::to_string(start(bytes)) + ": the face has 2 corners: at least 3 are needed");
    bytes = file("uchar int", std::uint8_t{200}, std::int32_t{2});
    bytes.replace(start(bytes) + 13, 9, std::string(9, '\0'));
    EXPECT_EQ(refusal("ply", bytes), ": byte " + std::to_string(bytes.size()) +
                                         ": the file ends inside row 0 of the 1 of element 'face', counted from 0");
}

TEST(ReadPly, HeaderLinesMayEndInThreeWays) {
    for (const char* line_end : {"\r\n", "\r"}) {
        std::string bytes = with_last_x("float", 10.0F);  // the first byte of the body is 0
        const std::size_t header_end = bytes.find("end_header\n") + 11;
        std::string header;
        for (const char c : bytes.substr(0, header_end)) {
            header += c == '\n' ? line_end : std::string(1, c);
        }
        EXPECT_EQ(read("ply", header + bytes.substr(header_end)).positions[2][0], 10.0);
    }
    // The body may begin with a byte that looks like the second half of a line end.
    std::string bytes =
        "ply\rformat binary_little_endian 1.0\relement vertex 3\rproperty char x\rproperty char y\rproperty char z\r"
        "element face 1\rproperty list char char vertex_indices\rend_header\r";
    bytes += std::string("\n\0\0\1\0\0\0\1\0\3\0\1\2", 13);
    EXPECT_EQ(read("ply", bytes).positions[0][0], 10.0);
    EXPECT_EQ(refusal("ply", "ply\rformat odd 1.0\r"), ":2: format 'odd' is not known");
}

TEST(ReadPly, LeavesAloneWhatFollowsTheLastRow) {
    EXPECT_EQ(read("ply", text_ply(k_vertex + k_face, k_rows + "more\n")).triangles.size(), 1U);
    EXPECT_EQ(read("ply", binary_ply(std::endian::big) + std::string(1000, '\0')).triangles.size(), 4U);
}

TEST(ReadPly, RefusesHeadersThatAreWrong) {
    const auto header = [](const std::string& lines) {
        return refusal("ply", "ply\nformat ascii 1.0\n" + lines + "end_header\n" + k_rows);
    };
    EXPECT_EQ(refusal("ply", "PLY\n"), ":1: begins with 'PLY', not with 'ply'");
    EXPECT_EQ(refusal("ply", "ply x\n"), ":1: the line goes on with 'x'");
    EXPECT_EQ(refusal("ply", "ply\n" + k_vertex + k_face + "end_header\n" + k_rows), ":8: the header names no format");
    EXPECT_EQ(refusal("ply", "ply\nformat\n"), ":2: the line ends where a format is expected");
    EXPECT_EQ(refusal("ply", "ply\nformat binary 1.0\n"), ":2: format 'binary' is not known");
    EXPECT_EQ(refusal("ply", "ply\nformat ascii\n"), ":2: the line ends where a version is expected");
    EXPECT_EQ(refusal("ply", "ply\nformat ascii 2.0\n"), ":2: version '2.0' is not known: only 1.0 is");
    EXPECT_EQ(refusal("ply", "ply\nformat ascii 1.0\n" + k_vertex),
              ":7: the file ends inside the header: there is no end_header");
    EXPECT_EQ(header("elements vertex 3\n"), ":3: unknown header line 'elements'");
    EXPECT_EQ(header("element\n"), ":3: the line ends where a name is expected");
    EXPECT_EQ(header("element vertex\n"), ":3: '' is not a count");
    EXPECT_EQ(header("element vertex -3\n"), ":3: '-3' is not a count");
    EXPECT_EQ(header("element vertex 3.5\n"), ":3: '3.5' is not a count");
    EXPECT_EQ(header("element vertex 3 4\n"), ":3: the line goes on with '4'");
    EXPECT_EQ(header(k_vertex + k_vertex), ":7: element 'vertex' comes twice");
    EXPECT_EQ(header("property float x\n"), ":3: a property stands before the first element");
    EXPECT_EQ(header("element vertex 3\nproperty float\n"), ":4: the line ends where a name is expected");
    EXPECT_EQ(header("element vertex 3\nproperty half x\n"), ":4: type 'half' is not known");
    EXPECT_EQ(header("element vertex 3\nproperty list uchar\n"), ":4: the line ends where a type is expected");
    EXPECT_EQ(header("element vertex 3\nproperty list float int x\n"),
              ":4: the length of a list can't be a floating-point number");
    EXPECT_EQ(header("element vertex 3\nproperty float x\nproperty int x\n"), ":5: property 'x' comes twice");
}

TEST(ReadPly, RefusesHeadersWithoutAMesh) {
    const auto header = [](const std::string& lines) { return refusal("ply", text_ply(lines, k_rows)); };
    EXPECT_EQ(header(k_vertex), ": holds no face");
    EXPECT_EQ(header(k_vertex + "element face 0\nproperty list uchar int vertex_indices\n"), ": holds no face");
    EXPECT_EQ(header(k_face), ":3: there are faces, but no element 'vertex'");
    EXPECT_EQ(header("element vertex 3\nproperty float x\nproperty float y\n" + k_face),
              ":3: element 'vertex' has no number 'z'");
    EXPECT_EQ(header("element vertex 3\nproperty float y\nproperty float z\nproperty list int int x\n" + k_face),
              ":3: element 'vertex' has no number 'x'");
    EXPECT_EQ(header(k_vertex + "element face 1\nproperty list uchar int corners\n"),
              ":7: element 'face' has no list 'vertex_indices'");
    EXPECT_EQ(header(k_vertex + "element face 1\nproperty int vertex_indices\n"),
              ":7: element 'face' has no list 'vertex_indices'");
    EXPECT_EQ(header(k_vertex + k_face + "property list uchar int vertex_index\n"),
              ":9: element 'face' has two lists of corners");
    EXPECT_EQ(header(k_vertex + "element face 1\nproperty list uchar float vertex_index\n"),
              ":8: corners can't be floating-point numbers");
}

TEST(ReadPly, RefusesCountsForWhichTheFileIsTooShort) {
    EXPECT_EQ(
        refusal("ply",
                text_ply("element vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n" + k_face,
                         k_rows)),
        ":3: 4000000000 rows of element 'vertex', of at least 6 bytes each, do not fit in the 27 that are left");
    EXPECT_EQ(refusal("ply", text_ply(k_vertex + "element face 2\nproperty list uchar int vertex_indices\n", k_rows)),
              ":7: 2 rows of element 'face', of at least 8 bytes each, do not fit in the 9 that are left");
    EXPECT_EQ(
        refusal("ply", text_ply("element odd 1000000000000000000000\nproperty float x\n" + k_vertex + k_face, k_rows)),
        ":3: 1000000000000000000 rows of element 'odd', of at least 2 bytes each, do not fit in the 27 that are left");
    // Without properties a row has no bytes: nothing is wrong with any number of them, and there is nothing to loop
    // over.
    EXPECT_EQ(refusal("ply", text_ply("element odd 1000000000000000000000\n" + k_vertex + k_face, k_rows)), "read");
    std::string bytes = binary_ply(std::endian::little);
    bytes.replace(bytes.find("face 3"), 6, "face 9");
    EXPECT_EQ(refusal("ply", bytes),
              ":12: 9 rows of element 'face', of at least 21 bytes each, do not fit in the 86 that are left");
    bytes = binary_ply(std::endian::little);
    bytes.pop_back();
    EXPECT_EQ(refusal("ply", bytes), ": byte " + std::to_string(bytes.size()) +
                                         ": the file ends inside row 2 of the 3 of element 'face', counted from 0");
}

TEST(ReadPly, RefusesTextRowsThatAreWrong) {
    const auto rows = [](const std::string& text) { return refusal("ply", text_ply(k_vertex + k_face, text)); };
    EXPECT_EQ(rows("0 0\n1 0 0\n0 1 0 0\n3 0 1 2\n"), ":10: the line ends before its last property");
    EXPECT_EQ(rows("0 0 0 7\n1 0 0\n0 1 0\n3 0 1 2\n"), ":10: the line goes on behind its last property");
    EXPECT_EQ(rows("0 0 0\n1 0 0\n0 1 0\n3 0 1 2 3\n"), ":13: the line goes on behind its last property");
    EXPECT_EQ(rows("0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n"), ":13: the line ends before its last property");
    EXPECT_EQ(rows("0 0 0\n1 0 0\n0 1 0.000000\n\n"), ":14: the file ends after 0 of 1 row of element 'face'");
    EXPECT_EQ(rows("0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"), ":11: coordinate 'nan' is not finite");
    EXPECT_EQ(rows("0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n"), ":11: 'x' is not a number");
    EXPECT_EQ(rows("0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
              ":13: face 0: vertex index 3 is out of range (3 vertices, counted from 0)");
    EXPECT_EQ(rows("0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"),
              ":13: face 0: vertex index -1 is out of range (3 vertices, counted from 0)");
    EXPECT_EQ(rows("0 0 0\n1 0 0\n0 1 0\n3 0 1 18446744073709551616\n"),
              ":13: '18446744073709551616' is not an integer of at most 32 bits");
    EXPECT_EQ(rows("0 0 0\n1 0 0\n0 1 0\n3 0 1 1.0\n"), ":13: '1.0' is not an integer");
    EXPECT_EQ(rows("0 0 0\n1 0 0\n0 1 0\n-3 0 1 1\n"), ":13: a list can't have -3 numbers");
    EXPECT_EQ(rows("0 0 0\n1 0 0\n0 1 0\n2 0 1  \n"), ":13: the face has 2 corners: at least 3 are needed");
    EXPECT_EQ(rows("0 0 0\n1 0 0\n0 1 0\n4294967295 0 1 2\n"), ":13: the line ends before its last property");
}

}  // namespace
}  // namespace pierce

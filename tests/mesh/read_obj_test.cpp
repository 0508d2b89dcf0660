// OBJ: its statements, its indices, and each refusal.
#include "read_test_support.h"

namespace pierce {
namespace {

using test::read;
using test::refusal;

using Triangles = std::vector<IndexTriple>;
const std::string k_square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ReadObj, ReadsPositionsAndFaces) {
    const auto mesh = read<float>("obj", "v 0 0.5 -1\nv 1 2 3\nv 4 5 6\nf 1 2 3\nf 3 2 1");
    ASSERT_EQ(mesh.positions.size(), 3U);
    EXPECT_EQ(mesh.positions[0], Vec3<float>(0, 0.5F, -1));
    EXPECT_EQ(mesh.positions[2], Vec3<float>(4, 5, 6));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {2, 1, 0}}));
}

TEST(ReadObj, TakesWeightsAndColoursBehindAPosition) {
    const auto mesh = read(
        "obj", "v 1 2 3\nv 1 2 3 0.5\nv 1 2 3 .1 .2 .3\nv 1 2 3 1 .1 .2 .3\nv 1 2 3 nan 1e999 -1 # grey\nf 1 2 3\n");
    ASSERT_EQ(mesh.positions.size(), 5U);
    for (const auto& position : mesh.positions) {
        EXPECT_EQ(position, Vec3<double>(1, 2, 3));
    }
    EXPECT_EQ(refusal("obj", "v 1 2\n"), ":1: the vertex has 2 numbers: 3, 4, or 6 and more are expected");
    EXPECT_EQ(refusal("obj", "\nv\n"), ":2: the vertex has 0 numbers: 3, 4, or 6 and more are expected");
    EXPECT_EQ(refusal("obj", "v 1 2 3 4 5\n"), ":1: the vertex has 5 numbers: 3, 4, or 6 and more are expected");
    EXPECT_EQ(refusal("obj", "v 1 2 3 red\n"), ":1: 'red' is not a number");
}

TEST(ReadObj, TakesEveryFormOfCorner) {
    const Triangles expected = {{0, 1, 2}};
    for (const char* face :
         {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//2 3//3", "f 1/1/1 2/2/2 3/3/3", "f -4 -3 -2", "f -4/-1/-1 2//-7 3/9/",
          "f 1/ 2/ 3/", "f +1 2 3", "f 1// 2 3", "f\t1\t2 \t 3 \t", "f 1 2 3 # last", "  f 1 2 3", "f 1 2 3\r",
          "f 1 \\\n 2 \\\r\n\t3", "f 1\\\n 2\\\n 3", "f\\\n 1 2 3"}) {
        EXPECT_EQ(read("obj", k_square + face).triangles, expected) << face;
        EXPECT_EQ(read("obj", k_square + face + "\n").triangles, expected) << face;
    }
    for (const std::string corner : {"x", "1/2/3/4", "1-2", "1.0", "/1", "1#", "-"}) {
        EXPECT_EQ(refusal("obj", k_square + "f 1 2 " + corner), ":5: '" + corner + "' is not a corner");
    }
    for (const std::string part : {"x", "-", "1.5"}) {
        EXPECT_EQ(refusal("obj", k_square + "f 1 2 1/" + part).substr(0, 5), ":5: '");
        EXPECT_EQ(refusal("obj", k_square + "f 1 2 1//" + part).substr(0, 5), ":5: '");
    }
}

TEST(ReadObj, EndsLinesInThreeWays) {
    const auto expected = read("obj", k_square + "f 1 2 3\nf 1 3 4\n").triangles;
    for (const char* line_end : {"\n", "\r\n", "\r", "\n\n", " \t\n", "\r\n\r\n", "\n\r"}) {
        std::string text;
        for (const char c : "# made by hand\n" + k_square + "f 1 2 3\nf 1 3 4") {
            text += c == '\n' ? line_end : std::string(1, c);
        }
        EXPECT_EQ(read("obj", text).triangles, expected);
        EXPECT_EQ(read("obj", text + line_end).triangles, expected);
    }
    EXPECT_EQ(refusal("obj", "#\r\n#\r\nv 1\r\n"), ":3: the vertex has 1 number: 3, 4, or 6 and more are expected");
    EXPECT_EQ(refusal("obj", "#\r#\rv 1\r"), ":3: the vertex has 1 number: 3, 4, or 6 and more are expected");
}

TEST(ReadObj, IndicesCountFromTheirFaceBackwardOrMayRunAhead) {
    const auto backward = read("obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -3 -2 -1\n");
    EXPECT_EQ(backward.triangles, (Triangles{{0, 1, 2}, {1, 2, 3}}));
    EXPECT_EQ(read("obj", "f 3 2 1\nf 4 2 3\n" + k_square).triangles, (Triangles{{2, 1, 0}, {3, 1, 2}}));
}

TEST(ReadObj, RefusesIndicesOutOfRange) {
    EXPECT_EQ(refusal("obj", k_square + "f 1 2 5\n"), ":5: face 0: vertex index 5 is out of range (4 vertices)");
    EXPECT_EQ(refusal("obj", k_square + "f 1 2 5/1/1\n"), ":5: face 0: vertex index 5 is out of range (4 vertices)");
    EXPECT_EQ(refusal("obj", k_square + "f 1 2 0\n"),
              ":5: face 0: vertex index 0 is out of range (vertices are counted from 1)");
    EXPECT_EQ(refusal("obj", "v 0 0 0\nf 1 1 -2//3\nv 0 0 0\n"),
              ":2: face 0: vertex index -2 is out of range (1 vertex before it)");
    // 2^32 + 1 and 2^64 + 1 would be 1 in 32 and 64 bits.
    for (const char* huge :
         {"4294967297", "18446744073709551617", "+9223372036854775808", "1000000000000000000000000000000"}) {
        EXPECT_EQ(refusal("obj", k_square + "f 1 2 " + huge),
                  ":5: face 0: vertex index " + std::string(huge) + " is out of range (4 vertices)");
    }
    EXPECT_EQ(refusal("obj", k_square + "f 1 2 -18446744073709551615\n"),
              ":5: face 0: vertex index -18446744073709551615 is out of range (4 vertices before it)");
}

TEST(ReadObj, NamesTheFirstFaceThatRunsTooFarAhead) {
    // Of the corners ahead, 3 and 4 come to exist; 6 is the first that does not, and 9 is further off.
    EXPECT_EQ(refusal("obj", "f 3 1 2\nf 4 3 1\nf 2 1 6\nf 9 1 1\nf 5 5 5\n" + k_square),
              ":3: face 2: vertex index 6 is out of range (4 vertices)");
    EXPECT_EQ(refusal("obj", "f 1 2 3\n"), ":1: face 0: vertex index 1 is out of range (0 vertices)");
}

TEST(ReadObj, KeepsDegenerateAndDuplicateFaces) {
    const auto mesh = read("obj", k_square + "f 1 1 2\nf 3 3 3\nf 1 2 3\nf 1 2 3\nf 1 1 2 2\n");
    EXPECT_EQ(mesh.triangles.size(), 6U);
    EXPECT_EQ(mesh.face_count(), 5U);
}

TEST(ReadObj, RefusesFacesThatAreNone) {
    EXPECT_EQ(refusal("obj", k_square + "f 1 2\n"), ":5: the face has 2 corners: at least 3 are needed");
    EXPECT_EQ(refusal("obj", k_square + "f 1\n"), ":5: the face has 1 corner: at least 3 are needed");
    EXPECT_EQ(refusal("obj", k_square + "f\n"), ":5: the face has 0 corners: at least 3 are needed");
    EXPECT_EQ(refusal("obj", k_square), ": holds no face");
}

TEST(ReadObj, PassesOverWhatHoldsNoSurface) {
    const auto mesh =
        read("obj", "mtllib C:\\a b\\\no ship\ng hull \\\n deck\n" + k_square +
                        "vt 0.5 \\\n 0.5\nvn 0 0 1\nvp 1\ns off\nusemtl steel#3\nl 1 2 \\\n3\np 1\nmg 1 2\nlod 1\n"
                        "bevel on\nf 1 2 3\n");
    EXPECT_EQ(mesh.positions.size(), 4U);
    EXPECT_EQ(mesh.triangles.size(), 1U);
}

// The backslash belongs to the name, and the next line is a statement of its own.
TEST(ReadObj, ABackslashBehindANameHidesNothing) {
    EXPECT_EQ(read("obj", k_square + "f 1 2 3\nusemtl C:\\maps\\\nf 1 3 4\n").triangles.size(), 2U);
    EXPECT_EQ(read("obj", k_square + "# C:\\maps\\\nf 1 3 4\n").triangles.size(), 1U);
}

// Comments in Viewpoint's files, which are everywhere. They were unknown statements.
TEST(ReadObj, PassesOverLinesThatBeginWithADollar) {
    const auto mesh = read("obj", "$ Viewpoint\n$\n" + k_square + "  $Id: C:\\a\\\n\t$f 1 2 3\nf 1 2 3 # $\n$");
    EXPECT_EQ(mesh.positions.size(), 4U);
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
    EXPECT_EQ(refusal("obj", k_square + "f 1 2 $3\n"), ":5: '$3' is not a corner");
}

TEST(ReadObj, RefusesWhatItDoesNotKnow) {
    EXPECT_EQ(refusal("obj", "hello world\n"), ":1: unknown statement 'hello'");
    EXPECT_EQ(refusal("obj", k_square + "call other.obj\n"), ":5: unknown statement 'call'");
    EXPECT_EQ(refusal("obj", k_square + "F 1 2 3\n"), ":5: unknown statement 'F'");
    EXPECT_EQ(refusal("obj", k_square + "cstype bezier\n"), ":5: free-form curves and surfaces are not read: 'cstype'");
    EXPECT_EQ(refusal("obj", k_square + "\n#\n\tsurf 0 1 0 1 1 2 3 4\n"),
              ":7: free-form curves and surfaces are not read: 'surf'");
}

}  // namespace
}  // namespace pierce

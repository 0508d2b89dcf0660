// OFF: the variants of its header, and each refusal.
#include "read_test_support.h"

namespace pierce {
namespace {

using test::read;
using test::refusal;

const std::string k_body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST(ReadOff, TakesEveryPlaceForTheCounts) {
    for (const char* header :
         {"OFF\n3 1 0\n", "OFF 3 1 0\n", "OFF3 1 0\n", "OFF\r\n3 1 3\r\n",
          "# made by hand\n\nOFF # plain\n# counts\n3 1\n", "  OFF\n\n 3\t1 0 # three\n", "OFF 3 +1 -1\n"}) {
        const auto mesh = read("off", header + k_body);
        EXPECT_EQ(mesh.positions.size(), 3U) << header;
        EXPECT_EQ(mesh.triangles, (std::vector<IndexTriple>{{0, 1, 2}})) << header;
    }
}

TEST(ReadOff, TakesExtraNumbersThatTheHeaderNames) {
    const auto file = [](const std::string& keyword, const std::string& extra) {
        return keyword + "\n3 1 0\n1 2 3" + extra + "\n4 5 6" + extra + "\n7 8 10" + extra + "\n3 0 1 2\n";
    };
    const std::vector<std::pair<std::string, std::string>> variants = {{"COFF", " 255 0 0"},
                                                                       {"COFF", " 255 0 0 255"},
                                                                       {"NOFF", " 0 0 1"},
                                                                       {"STOFF", " .5 .5"},
                                                                       {"CNOFF", " 0 0 1 1 1 1"},
                                                                       {"NCOFF", " 0 0 1 1 1 1 1"},
                                                                       {"STCNOFF", " 0 0 1 1 1 1 1 0 0"},
                                                                       {"STNOFF", " 1 2 3 4 5"}};
    for (const auto& [keyword, extra] : variants) {
        const auto mesh = read("off", file(keyword, extra));
        EXPECT_EQ(mesh.positions[2], Vec3<double>(7, 8, 10)) << keyword;
    }
    EXPECT_EQ(refusal("off", file("COFF", " 1 1")), ":3: the vertex has 5 numbers: 6 or 7 are expected");
    EXPECT_EQ(refusal("off", file("NOFF", "")), ":3: the vertex has 3 numbers: 6 are expected");
    EXPECT_EQ(refusal("off", file("STOFF", " 1 2 3")), ":3: the vertex has 6 numbers: 5 are expected");
    EXPECT_EQ(refusal("off", file("COFF", " 1 1 red")), ":3: 'red' is not a number");
}

// Many programs write colours behind the positions and leave the keyword as it is.
TEST(ReadOff, TakesColoursUnderAPlainKeyword) {
    const auto file = [](const std::string& first, const std::string& second, const std::string& third) {
        return "OFF\n3 1 0\n1 2 3" + first + "\n4 5 6" + second + "\n7 8 10" + third + "\n3 0 1 2\n";
    };
    for (const std::string colour : {" 255 0 0", " .5 .5 .5 1", " 200 100 50 255 # red"}) {
        const auto mesh = read("off", file(colour, colour, colour));
        EXPECT_EQ(mesh.positions[1], Vec3<double>(4, 5, 6)) << colour;
        EXPECT_EQ(mesh.positions[2], Vec3<double>(7, 8, 10)) << colour;
        EXPECT_EQ(mesh.triangles, (std::vector<IndexTriple>{{0, 1, 2}})) << colour;
    }
    // What the first vertex has, all have: two vertices that got onto one line are not one with a colour.
    EXPECT_EQ(refusal("off", file(" 1 1 1", "", "")),
              ":4: the vertex has 3 numbers: 6 are expected, as the first one has");
    EXPECT_EQ(refusal("off", file("", "", " 1 1 1")),
              ":5: the vertex has 6 numbers: 3 are expected, as the first one has");
    EXPECT_EQ(refusal("off", file(" 1 1 1", " 1 1 1", " 1 1 1 1")),
              ":5: the vertex has 7 numbers: 6 are expected, as the first one has");
    for (const std::string odd : {" 1", " 1 1", " 1 1 1 1 1"}) {
        const std::string has = std::to_string(3 + odd.size() / 2);
        EXPECT_EQ(refusal("off", file(odd, odd, odd)),
                  ":3: the vertex has " + has + " numbers: 3, 6 or 7 are expected");
    }
    EXPECT_EQ(refusal("off", file(" 1 1 red", "", "")), ":3: 'red' is not a number");
}

// CGAL's own mesh_with_colors.off has a vertex line that ends in `0#red`.
TEST(ReadOff, ACommentMayTouchANumber) {
    const auto mesh = read("off", "OFF# plain\n3 1 0#counts\n1 2 3# a\n4 5 6e0#b\n7 8 10#\n3 0 1 2#c\n");
    EXPECT_EQ(mesh.positions[0], Vec3<double>(1, 2, 3));
    EXPECT_EQ(mesh.positions[1], Vec3<double>(4, 5, 6));
    EXPECT_EQ(mesh.positions[2], Vec3<double>(7, 8, 10));
    EXPECT_EQ(mesh.triangles, (std::vector<IndexTriple>{{0, 1, 2}}));
    // It ends the line, and hides what would be missing as little as any other.
    EXPECT_EQ(refusal("off", "OFF 3 1 0\n0 0#0\n1 0 0\n0 1 0\n3 0 1 2\n"),
              ":2: the vertex has 2 numbers: 3, 6 or 7 are expected");
    // What old Microsoft libraries write for infinity has no digit there.
    for (const std::string word : {"1.#INF", "-1.#IND", "1.#QNAN0", "-#", "1e#", "1x#"}) {
        EXPECT_EQ(refusal("off", "OFF 3 1 0\n0 0 " + word + "\n1 0 0\n0 1 0\n3 0 1 2\n"),
                  ":2: '" + word + "' is not a number");
    }
}

TEST(ReadOff, ReadsCgalsMeshWithColours) {
    const auto mesh = read_mesh<double>(std::string(PIERCE_CGAL_MESHES) + "/mesh_with_colors.off");
    EXPECT_EQ(mesh.positions.size(), 8U);
    EXPECT_EQ(mesh.positions[2], Vec3<double>(1, -1, 0));
    EXPECT_EQ(mesh.face_count(), 4U);
    EXPECT_EQ(mesh.triangles.size(), 6U);
}

// The counts one a line: the message was that the vertex has 1 number.
TEST(ReadOff, TakesCountsOverSeveralLines) {
    for (const char* header : {"OFF\n3\n1\n0\n", "OFF\n3 1\n0\n", "OFF\n3\n1 0\n", "OFF 3\n1\n",
                               "OFF 3\n\n# faces\n1\n\n-1 # edges\n", "OFF\n3\n1\n"}) {
        const auto mesh = read("off", header + k_body);
        EXPECT_EQ(mesh.positions.size(), 3U) << header;
        EXPECT_EQ(mesh.triangles, (std::vector<IndexTriple>{{0, 1, 2}})) << header;
    }
    EXPECT_EQ(refusal("off", "OFF\n3 1\nmany\n" + k_body), ":3: 'many' is not a number of edges");
    EXPECT_EQ(refusal("off", "OFF\n3 1\n0\n7\n" + k_body), ":4: the vertex has 1 number: 3, 6 or 7 are expected");
    EXPECT_EQ(refusal("off", "OFF\n3 1\n"), ":2: 3 vertices and 1 face do not fit in the 0 bytes that are left");
}

TEST(ReadOff, TakesFacesOfAnySizeWithAColour) {
    const auto mesh = read("off",
                           "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n-1 .5 0\n4 0 1 2 3 0.5 0.5 0.5\n3 0 1 2 7\n5 0 1 2 "
                           "3 4 1 2 3 4\n3 1 1 1\n");
    EXPECT_EQ(mesh.triangles.size(), 7U);
    EXPECT_EQ(mesh.faces, (std::vector<std::uint32_t>{0, 0, 1, 2, 2, 2, 3}));
    EXPECT_EQ(refusal("off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 2 3 4 5\n"),
              ":5: the line has 5 numbers behind the face: a colour has at most 4");
    EXPECT_EQ(refusal("off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 red\n"), ":5: 'red' is not a number");
}

TEST(ReadOff, LeavesAloneWhatFollowsTheLastFace) {
    EXPECT_EQ(read("off", "OFF 3 1 0\n" + k_body + "anything at all\n").triangles.size(), 1U);
}

TEST(ReadOff, RefusesOtherKindsOfOff) {
    EXPECT_EQ(refusal("off", "OFF BINARY\n" + k_body), ":1: binary OFF files are not read");
    EXPECT_EQ(refusal("off", "COFF BINARY\n" + k_body), ":1: binary OFF files are not read");
    EXPECT_EQ(refusal("off", "4OFF\n3 1 0\n" + k_body), ":1: only points of 3 numbers are read, not those of '4OFF'");
    EXPECT_EQ(refusal("off", "nOFF\n3\n3 1 0\n" + k_body),
              ":1: only points of 3 numbers are read, not those of 'nOFF'");
    EXPECT_EQ(refusal("off", "C4nOFF\n3\n3 1 0\n" + k_body),
              ":1: only points of 3 numbers are read, not those of 'C4nOFF'");
    EXPECT_EQ(refusal("off", "3 1 0\n" + k_body), ":1: begins with '3', not with OFF");
    EXPECT_EQ(refusal("off", "\nOFFSET 1\n"), ":2: begins with 'OFFSET', not with OFF");
    EXPECT_EQ(refusal("off", "\n\n"), ":3: begins with '', not with OFF");
}

TEST(ReadOff, RefusesCountsThatAreNone) {
    EXPECT_EQ(refusal("off", "OFF\n"), ":2: the number of vertices is missing");
    EXPECT_EQ(refusal("off", "OFF\n3\n"), ":3: the number of faces is missing");
    EXPECT_EQ(refusal("off", "OFF\n-1 -1 0\n"), ":2: '-1' is not a number of vertices");
    EXPECT_EQ(refusal("off", "OFF\n3 1.5 0\n"), ":2: '1.5' is not a number of faces");
    EXPECT_EQ(refusal("off", "OFF\n3 1 many\n"), ":2: 'many' is not a number of edges");
    EXPECT_EQ(refusal("off", "OFF\n3 1 0 7\n" + k_body), ":2: the line goes on behind the three counts");
    EXPECT_EQ(refusal("off", "OFF\n3 0 0\n" + k_body), ": holds no face");
    EXPECT_EQ(refusal("off", "OFF\n0 0 0\n"), ": holds no face");
}

TEST(ReadOff, RefusesCountsForWhichTheFileIsTooShort) {
    EXPECT_EQ(refusal("off", "OFF\n4000000000 4000000000 0\n0 0 0\n"),
              ":2: 4000000000 vertices and 4000000000 faces do not fit in the 6 bytes that are left");
    EXPECT_EQ(refusal("off", "OFF 3 4 0\n" + k_body),
              ":1: 3 vertices and 4 faces do not fit in the 26 bytes that are left");
    EXPECT_EQ(refusal("off", "OFF 99999999999999999999999 1 0\n" + k_body),
              ":1: 1000000000000000000 vertices and 1 face do not fit in the 26 bytes that are left");
    EXPECT_EQ(refusal("off", "OFF 3 2 0\n0 0 0.00000000000000\n1 0 0\n0 1 0\n3 0 1 2\n"),
              ":6: the file ends after 1 of 2 faces");
    EXPECT_EQ(refusal("off", "OFF 4 0 0\n0 0 0.00000000000000\n1 0 0\n0 1 0\n"),
              ":5: the file ends after 3 of 4 vertices");
    // The shortest lines that there are, without the last line end, fit exactly.
    EXPECT_EQ(refusal("off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2"), "read");
}

TEST(ReadOff, RefusesFacesThatAreWrong) {
    const std::string start = "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
    const std::string room = "\n#############\n";
    EXPECT_EQ(refusal("off", start + "3 0 1 3"),
              ":5: face 0: vertex index 3 is out of range (3 vertices, counted from 0)");
    EXPECT_EQ(refusal("off", start + "3 0 1 -1"),
              ":5: face 0: vertex index -1 is out of range (3 vertices, counted from 0)");
    EXPECT_EQ(refusal("off", start + "3 0 1 18446744073709551616"),
              ":5: face 0: vertex index 18446744073709551616 is out of range (3 vertices, counted from 0)");
    EXPECT_EQ(refusal("off", start + "3 0 1 1.5"), ":5: '1.5' is not a corner");
    EXPECT_EQ(refusal("off", start + "3 0 1" + room), ":5: the line has 2 of the face's 3 corners");
    EXPECT_EQ(refusal("off", start + "4000000000 0 1 2"), ":5: the line has 3 of the face's 4000000000 corners");
    EXPECT_EQ(refusal("off", start + "2 0 1" + room), ":5: the face has 2 corners: at least 3 are needed");
    EXPECT_EQ(refusal("off", start + "0" + room), ":5: the face has 0 corners: at least 3 are needed");
    EXPECT_EQ(refusal("off", start + "-3 0 1 2"), ":5: '-3' is not a number of corners");
}

TEST(ReadOff, RefusesVerticesThatAreWrong) {
    EXPECT_EQ(refusal("off", "OFF 3 1 0\n0 0\n1 0 0\n0 1 0 0\n3 0 1 2\n"),
              ":2: the vertex has 2 numbers: 3, 6 or 7 are expected");
    EXPECT_EQ(refusal("off", "OFF 3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 0 0\n"), ":3: coordinate 'nan' is not finite");
    EXPECT_EQ(refusal<float>("off", "OFF 3 1 0\n0 0 0\n1 1e39 0\n0 1 0\n3 0 0 0\n"),
              ":3: coordinate '1e39' does not fit in float");
}

}  // namespace
}  // namespace pierce

// STL: telling text from binary, merging corners, and each refusal.
#include "read_test_support.h"

#include <limits>
#include <set>

namespace pierce {
namespace {

using test::binary_stl;
using test::read;
using test::refusal;

const std::string k_facet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n";
const std::string k_other =
    "facet normal 0 0 1\n outer loop\n  vertex 0 1 0\n  vertex 1 0 0\n  vertex 1 1 0\n endloop\nendfacet\n";
const std::vector<float> k_square = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};

TEST(ReadStl, ReadsTextAndMergesCorners) {
    const auto mesh = read("stl", "solid square\n" + k_facet + k_other + "endsolid square\n");
    EXPECT_EQ(mesh.positions.size(), 4U);
    EXPECT_EQ(mesh.triangles, (std::vector<IndexTriple>{{0, 1, 2}, {2, 1, 3}}));
}

TEST(ReadStl, ReadsSeveralSolids) {
    const auto mesh = read("stl", "solid\n" + k_facet + "endsolid\n\nsolid facet normal\n" + k_other +
                                      "endsolid two\nsolid none\nendsolid");
    EXPECT_EQ(mesh.triangles.size(), 2U);
    EXPECT_EQ(mesh.positions.size(), 4U);
}

TEST(ReadStl, TakesTextInAnyCaseAndLayout) {
    const auto mesh =
        read("stl",
             "\n SOLID a\r\nFACET NORMAL nan -nan(ind) x OUTER LOOP VERTEX 0 0 0 Vertex 1e0\n +0 0 vertex\n0 1 0\n"
             "ENDLOOP EndFacet ENDSOLID\r\n\r\n");
    EXPECT_EQ(mesh.triangles, (std::vector<IndexTriple>{{0, 1, 2}}));
}

// Some programs write what ends a part as two words.
TEST(ReadStl, TakesEndsInTwoWords) {
    const auto mesh =
        read("stl",
             "solid cube\nfacet normal 0 0 1 outer loop\nvertex 0 0 0 vertex 1 0 0 vertex 0 1 0\nend loop\n"
             "END Facet\nend \tsolid cube\nsolid two\n" +
                 k_other + "end solid\n");
    EXPECT_EQ(mesh.triangles, (std::vector<IndexTriple>{{0, 1, 2}, {2, 1, 3}}));
    const auto facet = [](const std::string& text) { return refusal("stl", "solid a\n" + text); };
    EXPECT_EQ(facet("end\n"), ":2: 'end' is not 'facet' or 'endsolid'");
    EXPECT_EQ(facet("end facet\n"), ":2: 'end' is not 'facet' or 'endsolid'");
    EXPECT_EQ(facet(k_facet + "end\nsolid\n"), ":9: 'end' is not 'facet' or 'endsolid'");
    EXPECT_EQ(facet("facet normal 0 0 1\nouter loop\nend vertex\n"), ":4: 'end' is not 'vertex' or 'endloop'");
}

TEST(ReadStl, ReadsBinary) {
    const auto mesh = read("stl", binary_stl(k_square));
    EXPECT_EQ(mesh.positions.size(), 4U);
    EXPECT_EQ(mesh.triangles, (std::vector<IndexTriple>{{0, 1, 2}, {2, 1, 3}}));
    EXPECT_EQ(read("stl", binary_stl(k_square, "solid fake")).triangles, mesh.triangles);
}

TEST(ReadStl, MergesEqualNumbersOnly) {
    const float next = std::nextafter(1.0F, 2.0F);
    const float least = std::numeric_limits<float>::denorm_min();
    const auto mesh =
        read<float>("stl", binary_stl({0, -0.0F, 0, 1, 0, 0, -0.0F, 0, -0.0F, least, 0, 0, next, 0, 0, 1, -0.0F, 0}));
    EXPECT_EQ(mesh.triangles, (std::vector<IndexTriple>{{0, 1, 0}, {2, 3, 1}})) << "zero-area faces are kept";
    EXPECT_FALSE(std::signbit(mesh.positions[0][1]));
    const auto text = read("stl",
                           "solid\nfacet normal 0 0 0 outer loop vertex 0.1 0 0 vertex 0.10000000000000001 0 0 "
                           "vertex 0.10000000000000002 0 0 endloop endfacet\nendsolid\n");
    EXPECT_EQ(text.triangles, (std::vector<IndexTriple>{{0, 0, 1}}));
}

TEST(ReadStl, MergesAsManyAsThereAre) {
    std::vector<float> coordinates;
    std::set<std::array<float, 3>> distinct;
    for (int i = 0; i < 30000; ++i) {
        const std::array<float, 3> corner = {static_cast<float>(i % 100), static_cast<float>(i % 77),
                                             static_cast<float>(i % 3)};
        distinct.insert(corner);
        coordinates.insert(coordinates.end(), corner.begin(), corner.end());
    }
    const auto mesh = read<float>("stl", binary_stl(coordinates));
    EXPECT_EQ(mesh.positions.size(), distinct.size());
    ASSERT_EQ(mesh.triangles.size(), 10000U);
    for (std::size_t i = 0; i < 30000; ++i) {
        EXPECT_EQ(mesh.positions[mesh.triangles[i / 3][i % 3]], Vec3<float>(&coordinates[3 * i]));
    }
}

TEST(ReadStl, CutsLoopsOfMoreCorners) {
    const auto mesh =
        read("stl",
             "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 4 0 0\nvertex 1 1 0\nvertex 0 4 0\nendloop\n"
             "endfacet\n" +
                 k_facet + "endsolid\n");
    EXPECT_EQ(mesh.faces, (std::vector<std::uint32_t>{0, 0, 1}));
}

TEST(ReadStl, RefusesBinaryOfAnotherSizeThanItsCountSays) {
    std::string bytes = binary_stl(k_square);
    EXPECT_EQ(refusal("stl", bytes + "x"), ": byte 80: 2 triangles make a file of 184 bytes: this one has 185");
    bytes.pop_back();
    EXPECT_EQ(refusal("stl", bytes), ": byte 80: 2 triangles make a file of 184 bytes: this one has 183");
    EXPECT_EQ(refusal("stl", binary_stl(k_square, "solid fake").substr(0, 183)),
              ": byte 80: 2 triangles make a file of 184 bytes: this one has 183");
    bytes.replace(80, 4, 4, '\xFF');
    EXPECT_EQ(refusal("stl", bytes),
              ": byte 80: 4294967295 triangles make a file of 214748364834 bytes: this one has 183");
    EXPECT_EQ(refusal("stl", bytes.substr(0, 83)), ": byte 83: the file ends inside the first 84 bytes");
    EXPECT_EQ(refusal("stl", "hello"), ": byte 5: the file ends inside the first 84 bytes");
    EXPECT_EQ(refusal("stl", binary_stl({})), ": holds no face");
}

TEST(ReadStl, RefusesBinaryCoordinatesThatAreNotFinite) {
    std::vector<float> coordinates = k_square;
    coordinates[9] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(refusal("stl", binary_stl(coordinates)), ": byte 146: a coordinate is not a number (NaN)");
    coordinates[8] = -std::numeric_limits<float>::infinity();
    EXPECT_EQ(refusal("stl", binary_stl(coordinates)), ": byte 128: a coordinate is infinite");
}

TEST(ReadStl, RefusesTextThatIsWrong) {
    const auto facet = [](const std::string& text) { return refusal("stl", "solid a\n" + text); };
    EXPECT_EQ(refusal("stl", "solid\nendsolid\n"), ": holds no face");
    EXPECT_EQ(facet(k_facet), ":9: the file ends where 'facet' or 'endsolid' is expected");
    EXPECT_EQ(facet(k_facet + "endsolid\n" + k_facet), ":10: 'facet' is not 'solid'");
    EXPECT_EQ(facet("facets\n"), ":2: 'facets' is not 'facet' or 'endsolid'");
    EXPECT_EQ(facet("facet\nouter loop\n"), ":3: 'outer' is not 'normal'");
    EXPECT_EQ(facet("facet normal 0 0\n"), ":3: the file ends where a number is expected");
    EXPECT_EQ(facet("facet normal 0 0 1\nouter ring\n"), ":3: 'ring' is not 'loop'");
    EXPECT_EQ(facet("facet normal 0 0 1\nouter loop\nvertex 0 0 nan\n"), ":4: coordinate 'nan' is not finite");
    EXPECT_EQ(facet("facet normal 0 0 1\nouter loop\nvertex 0 0 vertex\n"), ":4: 'vertex' is not a number");
    EXPECT_EQ(facet("facet normal 0 0 1\nouter loop\nvertex 0 0\n"), ":5: the file ends where a number is expected");
    EXPECT_EQ(facet("facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"),
              ":6: the face has 2 corners: at least 3 are needed");
    EXPECT_EQ(facet("facet normal 0 0 1\nouter loop\nvertex 0 0 0\nendfacet\n"),
              ":5: 'endfacet' is not 'vertex' or 'endloop'");
    EXPECT_EQ(facet("facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nfacet\n"),
              ":8: 'facet' is not 'endfacet'");
    EXPECT_EQ(refusal<float>("stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1e39\n"),
              ":4: coordinate '1e39' does not fit in float");
}

}  // namespace
}  // namespace pierce

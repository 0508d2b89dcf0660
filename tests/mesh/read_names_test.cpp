// What a game needs of each face beside its place: its material and its group. They were dropped, and nothing said so.
#include "read_test_support.h"

#include <pierce/collision_mesh.h>

namespace pierce {
namespace {

using test::binary_ply;
using test::binary_stl;

using Names = std::vector<std::string>;
using Numbers = std::vector<std::uint32_t>;

const std::string k_square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
constexpr ReadOptions k_both = {.materials = true, .groups = true};

TriangleSoup<double> read_all(std::string_view ending, std::string_view bytes) {
    return test::read(ending, bytes, k_both);
}

/// The name that `line` gives to the face behind it.
std::string material_after(const std::string& line) {
    const auto mesh = read_all("obj", k_square + line + "\nf 1 2 3\n");
    return mesh.material_of_face[0] == k_no_name ? "none" : mesh.materials.at(mesh.material_of_face[0]);
}
std::string group_after(const std::string& line) {
    const auto mesh = read_all("obj", k_square + line + "\nf 1 2 3\n");
    return mesh.group_of_face[0] == k_no_name ? "none" : mesh.groups.at(mesh.group_of_face[0]);
}

TEST(ReadNames, ObjHasMaterialsAndGroups) {
    const auto mesh = read_all("obj", k_square +
                                          "f 1 2 3\nusemtl wood\ng floor\nf 1 2 3 4\nusemtl stone\nf 1 2 3\no wall\n"
                                          "f 1 2 3\nusemtl wood\nf 3 4 1\n");
    EXPECT_EQ(mesh.materials, (Names{"wood", "stone"}));
    EXPECT_EQ(mesh.groups, (Names{"floor", "wall"}));
    // By face, not by triangle: the second face is two triangles.
    EXPECT_EQ(mesh.face_count(), 5U);
    EXPECT_EQ(mesh.triangles.size(), 6U);
    EXPECT_EQ(mesh.material_of_face, (Numbers{k_no_name, 0, 1, 1, 0}));
    EXPECT_EQ(mesh.group_of_face, (Numbers{k_no_name, 0, 0, 1, 1}));
    test::expect_valid(mesh);
}

TEST(ReadNames, AreLookedUpByTheFaceOfAHit) {
    // The wall is the file's second face, and its third triangle.
    const auto soup =
        read_all("obj", k_square + "v 0 0 9\nv 1 0 9\nv 1 1 9\nusemtl wood\nf 1 2 3 4\nusemtl stone\nf 5 6 7\n");
    const CollisionMesh<double> mesh(soup.view());
    const auto wall = mesh.first_hit({{0.5, 0.25, 10}, {0.5, 0.25, -1}});
    const auto floor = mesh.first_hit({{0.25, 0.5, 10}, {0.25, 0.5, -1}});
    ASSERT_TRUE(wall && floor);
    EXPECT_EQ(soup.materials.at(soup.material_of_face.at(wall->face)), "stone");
    EXPECT_EQ(soup.materials.at(soup.material_of_face.at(floor->face)), "wood");
}

TEST(ReadNames, AreKeptOnlyWhenAskedFor) {
    const std::string file = k_square + "usemtl wood\ng floor\nf 1 2 3\n";
    const auto neither = test::read("obj", file);
    EXPECT_TRUE(neither.materials.empty() && neither.material_of_face.empty());
    EXPECT_TRUE(neither.groups.empty() && neither.group_of_face.empty());
    const auto materials = test::read("obj", file, {.materials = true});
    EXPECT_EQ(materials.materials, Names{"wood"});
    EXPECT_EQ(materials.material_of_face, Numbers{0});
    EXPECT_TRUE(materials.groups.empty() && materials.group_of_face.empty());
    const auto groups = test::read("obj", file, {.groups = true});
    EXPECT_EQ(groups.groups, Names{"floor"});
    EXPECT_EQ(groups.group_of_face, Numbers{0});
    EXPECT_TRUE(groups.materials.empty() && groups.material_of_face.empty());
    EXPECT_EQ(neither.triangles, groups.triangles);
}

TEST(ReadNames, KeepTheirBytes) {
    for (const std::string name : {"a", "steel#3", "hull deck", "a  b\tc", "C:\\maps\\wood.png",
                                   "B\xC3\xB6"
                                   "den",
                                   "\xFF\x01", "(null)", "usemtl", "$", "-1", "f 1 2 3"}) {
        EXPECT_EQ(material_after("usemtl " + name), name);
        EXPECT_EQ(group_after("g " + name), name);
        EXPECT_EQ(group_after("o \t " + name + " \t "), name) << "the blanks around it are not part of it";
        EXPECT_EQ(group_after("o " + name + "\r"), name);
        EXPECT_EQ(group_after("o " + name + " # last"), name) << "nor is a comment";
    }
    EXPECT_EQ(group_after("g hull \\\n  deck"), "hull deck") << "one blank where the line is continued";
    EXPECT_EQ(group_after("g\\\nhull"), "hull");
    EXPECT_EQ(material_after("usemtl C:\\maps\\"), "C:\\maps\\") << "it hides no statement";
}

TEST(ReadNames, AKeywordWithoutANameEndsTheOneBefore) {
    EXPECT_EQ(material_after("usemtl wood\nusemtl"), "none");
    EXPECT_EQ(material_after("usemtl wood\nusemtl # none"), "none");
    EXPECT_EQ(group_after("o box\ng \t"), "none");
    EXPECT_EQ(group_after("g"), "none");
    EXPECT_EQ(material_after("usemtl"), "none");
    EXPECT_EQ(material_after("# usemtl wood"), "none");
    EXPECT_EQ(material_after("mtllib wood.mtl"), "none") << "libraries are not opened";
}

TEST(ReadNames, OfGroupsAndObjectsTheLastCounts) {
    EXPECT_EQ(group_after("o car\ng wheel"), "wheel");
    EXPECT_EQ(group_after("g wheel\no car"), "car");
    EXPECT_EQ(group_after("g wheel\nusemtl wood\ns 1"), "wheel");
}

TEST(ReadNames, ListNamesOnceInTheirOrder) {
    const auto mesh = read_all("obj", "usemtl unused\nusemtl a\nusemtl a\n" + k_square +
                                          "f 1 2 3\nusemtl b\nf 1 2 3\nusemtl a\nf 1 2 3\nusemtl B\nusemtl b\n"
                                          "f 1 2 3\nusemtl late\n");
    EXPECT_EQ(mesh.materials, (Names{"unused", "a", "b", "B", "late"}));
    EXPECT_EQ(mesh.material_of_face, (Numbers{1, 2, 1, 2}));
    EXPECT_EQ(mesh.group_of_face, Numbers(4, k_no_name)) << "asked for, and there is none";
    EXPECT_TRUE(mesh.groups.empty());
}

TEST(ReadNames, AreFoundAgainAmongMany) {
    std::string file = k_square;
    constexpr std::uint32_t names = 20'000;
    for (std::uint32_t i = 0; i < 2 * names; ++i) {
        file += "usemtl " + std::to_string(i * 7919 % names) + "\nf 1 2 3\n";
    }
    const auto mesh = read_all("obj", file);
    ASSERT_EQ(mesh.materials.size(), names);
    ASSERT_EQ(mesh.material_of_face.size(), 2 * names);
    for (std::uint32_t i = 0; i < 2 * names; ++i) {
        ASSERT_EQ(mesh.material_of_face[i], i % names);
        ASSERT_EQ(mesh.materials[i % names], std::to_string(i * 7919 % names));
    }
}

TEST(ReadNames, SolidsOfATextStlAreGroups) {
    const std::string facet = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n";
    const auto mesh = read_all("stl", "solid  left wing # 2 \r\n" + facet + facet + "endsolid\nsolid\n" + facet +
                                          "endsolid x\nsolid right\n" + facet +
                                          "end solid right\nSOLID left wing # 2\n" + facet + "endsolid");
    EXPECT_EQ(mesh.groups, (Names{"left wing # 2", "right"}));
    EXPECT_EQ(mesh.group_of_face, (Numbers{0, 0, k_no_name, 1, 0}));
    EXPECT_EQ(mesh.material_of_face, Numbers(5, k_no_name));
    EXPECT_TRUE(mesh.materials.empty());
}

TEST(ReadNames, OtherFormatsHaveNone) {
    const std::pair<std::string, std::string> files[] = {
        {"off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
        {"ply", binary_ply(std::endian::little)},
        {"stl", binary_stl({0, 0, 0, 1, 0, 0, 0, 1, 0}, "solid name")}};
    for (const auto& [ending, bytes] : files) {
        const auto mesh = read_all(ending, bytes);
        EXPECT_TRUE(mesh.materials.empty() && mesh.groups.empty()) << ending;
        EXPECT_EQ(mesh.material_of_face, Numbers(mesh.face_count(), k_no_name)) << ending;
        EXPECT_EQ(mesh.group_of_face, Numbers(mesh.face_count(), k_no_name)) << ending;
    }
}

}  // namespace
}  // namespace pierce

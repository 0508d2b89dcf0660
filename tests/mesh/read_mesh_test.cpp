// What all formats share: the door, numbers, and how a file is refused.
#include "read_test_support.h"

#include <cstdlib>

#include "mesh/read_soup_builder.h"

namespace pierce {
namespace {

using test::read;
using test::refusal;
using test::refusal_of;
using test::TempFile;

constexpr const char* k_triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// The first coordinate of a mesh whose file says `number` there.
template <class Scalar>
Scalar number(const std::string& number) {
    return read<Scalar>("obj", "v " + number + " 0 0\nf 1 1 1\n").positions[0][0];
}

TEST(ReadMesh, TellsTheKindFromTheEnding) {
    EXPECT_EQ(read("obj", k_triangle).triangles.size(), 1U);
    EXPECT_EQ(read("OBJ", k_triangle).triangles.size(), 1U);
    EXPECT_EQ(read("v2.Obj", k_triangle).triangles.size(), 1U);
    EXPECT_EQ(refusal("OFF", k_triangle), ":1: begins with 'v', not with OFF");
    EXPECT_EQ(refusal("Ply", k_triangle), ":1: begins with 'v', not with 'ply'");
    EXPECT_EQ(refusal("x3d", k_triangle), ": the ending '.x3d' is not one of .obj, .off, .ply and .stl");
    EXPECT_EQ(refusal("obj.gz", k_triangle), ": the ending '.gz' is not one of .obj, .off, .ply and .stl");
}

// A gzip file was said to begin with '????', or to have a wrong count of triangles.
TEST(ReadMesh, NamesPackedFiles) {
    using namespace std::string_view_literals;
    const std::pair<std::string_view, std::string> kinds[] = {
        {"\x1F\x8B\x08", "a gzip file"},       {"PK\3\4", "a zip archive"},         {"PK\5\6", "a zip archive"},
        {"\xFD\x37zXZ\0"sv, "an xz file"},     {"\x28\xB5\x2F\xFD", "a zstd file"}, {"BZh9", "a bzip2 file"},
        {"7z\xBC\xAF\x27\x1C", "a 7z archive"}};
    for (const auto& [start, kind] : kinds) {
        for (const char* ending : {"obj", "off", "ply", "stl", "obj.gz", "zip", ""}) {
            for (const std::size_t size : {10U, 83U, 84U, 1000U}) {
                std::string bytes(start);
                bytes.resize(size, '\1');
                EXPECT_EQ(refusal(ending, bytes), ": is " + kind + ": unpack it first") << ending << ' ' << size;
            }
        }
        // The first 80 bytes of a binary STL are free, and its size tells what it is.
        EXPECT_EQ(refusal("stl", test::binary_stl({0, 0, 0, 1, 0, 0, 0, 1, 0}, start)), "read");
    }
    EXPECT_EQ(refusal("obj", "PK 3\n"), ":1: unknown statement 'PK'");
}

TEST(ReadMesh, RefusesWhatIsNoFile) {
    const std::filesystem::path folder = testing::TempDir();
    EXPECT_EQ(refusal_of(folder / "pierce_no_such_file.obj"), ": can't be opened: No such file or directory");
    EXPECT_EQ(refusal_of(folder), ": is a directory");
    EXPECT_EQ(refusal_of("/dev/null"), ": is not a regular file");
    const TempFile file("obj", k_triangle);
    EXPECT_EQ(refusal_of(file.path() / "part.obj"), ": can't be opened: Not a directory");
    if (geteuid() != 0) {  // root may read everything
        std::filesystem::permissions(file.path(), std::filesystem::perms::none);
        EXPECT_EQ(refusal_of(file.path()), ": can't be opened: Permission denied");
    }
}

TEST(ReadMesh, RefusesEmptyFilesOfEveryKind) {
    for (const char* ending : {"obj", "off", "ply", "stl"}) {
        EXPECT_EQ(refusal(ending, ""), ": is empty") << ending;
    }
    EXPECT_EQ(refusal("obj", "\n"), ": holds no face");
    EXPECT_EQ(refusal("obj", "\xEF\xBB\xBF"), ": holds no face");
}

TEST(ReadMesh, AMessageIsOneLineWhateverTheFileHolds) {
    EXPECT_EQ(refusal("obj", std::string_view("v 0 0 a\0\x01\x7F\xC3\xA4\n", 13)), ":1: 'a\?\?\?\?\?' is not a number");
    EXPECT_EQ(refusal("obj", std::string(300, 'x')), ":1: unknown statement '" + std::string(40, 'x') + "...'");
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "two\nlines.obj";
    try {
        static_cast<void>(read_mesh<float>(path));
        FAIL();
    } catch (const MeshError& error) {
        EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos);
    }
}

TEST(ReadMesh, PassesOverAByteOrderMark) {
    const std::string mark = "\xEF\xBB\xBF";
    for (const test::SmallFile& file : test::small_files()) {
        if (file.ending != "stl" || file.bytes.starts_with("solid")) {
            EXPECT_EQ(read(file.ending, mark + file.bytes).triangles, read(file.ending, file.bytes).triangles);
        }
    }
}

TEST(ReadMesh, KeepsEveryDigit) {
    EXPECT_EQ(number<double>("0.30000000000000004"), 0.30000000000000004);
    EXPECT_EQ(number<double>("-1.7976931348623157e308"), -1.7976931348623157e308);
    EXPECT_EQ(number<double>("9007199254740993"), 9007199254740992.0);
    EXPECT_EQ(number<double>("5e-324"), 5e-324);
    EXPECT_EQ(number<double>("1e-310"), 1e-310);
    EXPECT_EQ(number<double>("1e-400"), 0.0);
    EXPECT_EQ(number<float>("1e-45"), 1e-45F);
    EXPECT_EQ(number<float>("3.4028235e38"), 3.4028235e38F);
    for (const char* one : {"1", "+1", "1.", "1.0", "+1e0", "0.1E1", "10e-1", "1000000000000000000000000e-24"}) {
        EXPECT_EQ(number<double>(one), 1.0) << one;
        EXPECT_EQ(number<float>(one), 1.0F) << one;
    }
}

// Just above the middle of 1 and the next float. Rounded to double first, it becomes that middle, and then 1.
TEST(ReadMesh, RoundsOnlyOnce) {
    const char* decimals = "1.000000059604644775390625000000001";
    EXPECT_EQ(static_cast<float>(number<double>(decimals)), 1.0F);
    EXPECT_EQ(number<float>(decimals), std::nextafter(1.0F, 2.0F));
}

TEST(ReadMesh, RefusesWhatIsNotANumber) {
    for (const char* word :
         {"a", "1a", "1,5", "1.2.3", "0x10", "--1", "+-1", "+", "-", ".", "1e", "e5", "1.5f", "1#2", "1d5"}) {
        EXPECT_EQ(refusal("obj", "v 0 0 " + std::string(word) + "\nf 1 1 1"),
                  ":1: '" + std::string(word) + "' is not a number");
    }
    EXPECT_EQ(refusal("obj", "v 0 0 + 1\nf 1 1 1"), ":1: '+' is not a number");
    // Written by old Microsoft libraries; the '#' begins no comment.
    EXPECT_EQ(refusal("obj", "v 0 0 1.#INF\nf 1 1 1"), ":1: '1.#INF' is not a number");
}

TEST(ReadMesh, RefusesWhatIsNotFiniteOrDoesNotFit) {
    for (const char* word : {"nan", "NaN", "-nan", "nan(ind)", "inf", "-inf", "+inf", "INFINITY"}) {
        EXPECT_EQ(refusal("obj", "v 0 " + std::string(word) + " 0\nf 1 1 1"),
                  ":1: coordinate '" + std::string(word) + "' is not finite");
    }
    EXPECT_EQ(refusal<float>("obj", "v 0 0 0\nv 0 -3.5e38 0\nf 1 1 1"),
              ":2: coordinate '-3.5e38' does not fit in float");
    EXPECT_EQ(refusal<double>("obj", "v 0 0 0\nv 0 -3.5e38 0\nf 1 1 1"), "read");
    EXPECT_EQ(refusal<double>("obj", "v 0 .2e309 0\nf 1 1 1"), ":1: coordinate '.2e309' does not fit in double");
    EXPECT_EQ(refusal<double>("obj", "v 0 1e999999999999 0\nf 1 1 1"),
              ":1: coordinate '1e999999999999' does not fit in double");
}

// The real limit is beyond any test's memory; the builder takes another.
TEST(ReadMesh, RefusesMoreThanIndicesCanName) {
    EXPECT_EQ(detail::k_most_vertices_or_triangles, 4294967294U);
    const TempFile file("obj", "x");
    const detail::SourceFile source(file.path());
    const std::vector<std::uint32_t> quad = {0, 1, 2, 3};
    const auto message = [&](auto act) -> std::string {
        detail::SoupBuilder<double> soup(source, {}, 4);
        try {
            act(soup);
        } catch (const MeshError& error) {
            return std::string(error.what()).substr(file.path().string().size());
        }
        return "taken";
    };
    const auto vertices = [](int count) {
        return [count](auto& soup) {
            for (int i = 0; i < count; ++i) {
                soup.add_vertex({0, 0, 0});
            }
        };
    };
    const auto quads = [&](int count) {
        return [&quad, count](auto& soup) {
            for (int i = 0; i < count; ++i) {
                soup.add_face(quad);
            }
        };
    };
    EXPECT_EQ(message(vertices(4)), "taken");
    EXPECT_EQ(message(vertices(5)), ": holds more than 4 vertices");
    EXPECT_EQ(message(quads(2)), "taken");
    EXPECT_EQ(message(quads(3)), ": holds more than 4 triangles");
}

TEST(ReadMesh, NumbersFacesOnceThereIsAPolygon) {
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 2 0\n";
    const auto triangles = read("obj", vertices + "f 1 2 3\nf 1 3 4\n");
    EXPECT_TRUE(triangles.faces.empty());
    EXPECT_EQ(triangles.face_count(), 2U);
    const auto mixed = read("obj", vertices + "f 1 2 3\nf 1 3 4\nf 1 2 3 4\nf 1 2 3\nf 1 2 3 5 4\n");
    EXPECT_EQ(mixed.faces, (std::vector<std::uint32_t>{0, 1, 2, 2, 3, 4, 4, 4}));
    EXPECT_EQ(mixed.face_count(), 5U);
    const auto polygon_first = read("obj", vertices + "f 1 2 3 4\nf 1 2 3\n");
    EXPECT_EQ(polygon_first.faces, (std::vector<std::uint32_t>{0, 0, 1}));
    test::expect_valid(mixed);
}

}  // namespace
}  // namespace pierce

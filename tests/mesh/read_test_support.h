// What the tests of the readers share: files in a temporary folder, messages without their path, and small valid files.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include <pierce/triangle_soup.h>

namespace pierce::test {

/// A file of the given bytes that lives as long as this object. Its name holds the process, since tests run side by
/// side.
class TempFile {
  public:
    TempFile(std::string_view ending, std::string_view bytes)
        : path_(std::filesystem::path(testing::TempDir()) / ("pierce_read_" + std::to_string(getpid()) + "_" +
                                                             std::to_string(++count_) + "." + std::string(ending))) {
        std::ofstream(path_, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
    ~TempFile() { std::filesystem::remove(path_); }
    TempFile(const TempFile&) = delete;
    TempFile& operator=(const TempFile&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    static inline int count_ = 0;
    std::filesystem::path path_;
};

template <class Scalar = double>
TriangleSoup<Scalar> read(std::string_view ending, std::string_view bytes, const ReadOptions& options = {}) {
    const TempFile file(ending, bytes);
    return read_mesh<Scalar>(file.path(), options);
}

/// The message with which a file is refused, less its path: ":3: reason". "read" if it is not refused.
template <class Scalar = double>
std::string refusal_of(const std::filesystem::path& path) {
    try {
        static_cast<void>(read_mesh<Scalar>(path));
    } catch (const MeshError& error) {
        const std::string message = error.what();
        EXPECT_TRUE(message.starts_with(path.string())) << message;
        EXPECT_EQ(message.find_first_of("\r\n"), std::string::npos) << message;
        return message.substr(path.string().size());
    }
    return "read";
}
template <class Scalar = double>
std::string refusal(std::string_view ending, std::string_view bytes) {
    return refusal_of<Scalar>(TempFile(ending, bytes).path());
}

/// Names of faces, if there are any: one a face, each in the list or none.
inline void expect_valid_names(const std::vector<std::uint32_t>& of_face, const std::vector<std::string>& names,
                               std::size_t faces) {
    EXPECT_TRUE(of_face.empty() ? names.empty() : of_face.size() == faces);
    for (const std::uint32_t name : of_face) {
        EXPECT_TRUE(name == k_no_name || name < names.size());
    }
    for (const std::string& name : names) {
        EXPECT_FALSE(name.empty());
        EXPECT_EQ(name.find_first_of("\r\n"), std::string::npos);
    }
}

/// Every index in range, every coordinate finite, faces numbered without gaps.
template <class Scalar>
void expect_valid(const TriangleSoup<Scalar>& mesh) {
    EXPECT_FALSE(mesh.triangles.empty());
    for (const auto& position : mesh.positions) {
        EXPECT_TRUE(std::isfinite(position[0]) && std::isfinite(position[1]) && std::isfinite(position[2]));
    }
    for (const IndexTriple& triangle : mesh.triangles) {
        EXPECT_LT(*std::max_element(triangle.begin(), triangle.end()), mesh.positions.size());
    }
    if (!mesh.faces.empty()) {
        ASSERT_EQ(mesh.faces.size(), mesh.triangles.size());
        EXPECT_EQ(mesh.faces[0], 0U);
        for (std::size_t i = 1; i < mesh.faces.size(); ++i) {
            EXPECT_LE(mesh.faces[i] - mesh.faces[i - 1], 1U);
        }
    }
    expect_valid_names(mesh.material_of_face, mesh.materials, mesh.face_count());
    expect_valid_names(mesh.group_of_face, mesh.groups, mesh.face_count());
}

/// Adds the bytes of a number in the given order.
template <class Number>
void put(std::string& bytes, Number number, std::endian order = std::endian::little) {
    char raw[sizeof(Number)];
    std::memcpy(raw, &number, sizeof(Number));
    if (order != std::endian::native) {
        std::reverse(raw, raw + sizeof(Number));
    }
    bytes.append(raw, sizeof(Number));
}

/// A binary STL file of the given triangles, nine coordinates each.
inline std::string binary_stl(const std::vector<float>& coordinates, std::string_view header = "made by a test") {
    std::string bytes(header);
    bytes.resize(80, ' ');
    put(bytes, static_cast<std::uint32_t>(coordinates.size() / 9));
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
        if (i % 9 == 0) {
            bytes.append(12, '\0');
        }
        put(bytes, coordinates[i]);
        if (i % 9 == 8) {
            bytes.append(2, '\0');
        }
    }
    return bytes;
}

/// A binary PLY file of a tetrahedron's two triangles and a quad, with properties and an element to be passed over.
inline std::string binary_ply(std::endian order) {
    std::string bytes = "ply\nformat binary_" + std::string(order == std::endian::big ? "big" : "little") +
                        "_endian 1.0\ncomment small\nelement vertex 5\nproperty uchar red\nproperty double z\n"
                        "property float x\nproperty short y\nelement note 2\nproperty list ushort double values\n"
                        "property int id\nelement face 3\nproperty float area\nproperty list uchar int vertex_indices\n"
                        "property list uint char flags\nend_header\n";
    const double points[5][3] = {{0, 0, 0}, {1.5, 0, 0.1}, {1.5, 2, 0}, {0, 2, 0}, {0, 0, -3}};
    for (const auto& point : points) {
        put(bytes, std::uint8_t{200}, order);
        put(bytes, point[2], order);
        put(bytes, static_cast<float>(point[0]), order);
        put(bytes, static_cast<std::int16_t>(point[1]), order);
    }
    for (const std::uint16_t length : {std::uint16_t{2}, std::uint16_t{0}}) {
        put(bytes, length, order);
        for (int i = 0; i < length; ++i) {
            put(bytes, 1.0, order);
        }
        put(bytes, std::int32_t{-7}, order);
    }
    for (const std::vector<std::int32_t>& face : {std::vector<std::int32_t>{0, 1, 4}, {0, 1, 2, 3}, {1, 2, 4}}) {
        put(bytes, 0.5F, order);
        put(bytes, static_cast<std::uint8_t>(face.size()), order);
        for (const std::int32_t corner : face) {
            put(bytes, corner, order);
        }
        put(bytes, std::uint32_t{1}, order);
        put(bytes, std::int8_t{-1}, order);
    }
    return bytes;
}

/// A binary PLY file of two triangle strips in one row.
inline std::string strips_ply() {
    std::string bytes =
        "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty char x\nproperty char y\nproperty char z\n"
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    bytes += std::string("\0\0\0\1\0\0\0\1\0\0\0\1", 12);
    put(bytes, std::int32_t{8}, std::endian::big);
    for (const std::int32_t corner : {0, 1, 2, 3, -1, 3, 1, 0}) {
        put(bytes, corner, std::endian::big);
    }
    return bytes;
}

struct SmallFile {
    std::string ending;
    std::string bytes;
};

/// One small valid file of each kind, with as many features as fit, to be damaged.
inline std::vector<SmallFile> small_files() {
    return {
        {"obj",
         "# small\nv 0 0 0\nv 1 0 0 1.0\nvn 0 0 1\nv 1 1.5e0 0\nv 0 +1 0 \\\n 1 0 0\nusemtl a\nf 1//1 2//1 3//1\n"
         "f -4 -3 \\\n-2 -1\r\nf 1/2/3 5 4/1\nv 2 2 2\n"},
        {"obj",
         "$ Viewpoint\no box\nv 0 0 0\nv 1 0 0\nv 1 1 0\ng left \\\n wing\nusemtl C:\\a\\\nf 1 2 3\nusemtl # none\n"
         "f 3 2 1\ng\nf 1 1 2\n"},
        {"off",
         "COFF # small\n4 2 0\n0 0 0 255 0 0\n1 0 0 255 0 0 255\n1 1 0 1 1 1\n\n0 1 -2.5 1 1 1\n4 0 1 2 3\n3 0 1 3 0.5 "
         "0.5 0.5\n"},
        {"off",
         "OFF#small\n4\n2\n0#edges\n0 0 0 200 100 50 255\n1 0 0 200 100 50 0#red\n1 1 0 200 100 50 255\n"
         "0 1 -2.5 200 100 50 1.0\n4 0 1 2 3\n3 0 1 3#red\n"},
        {"ply",
         "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "property list uchar int extra\nelement face 2\nproperty list uchar int vertex_index\nend_header\n"
         "0 0 0 0\n1 0 0 1 7\n1 1 0 2 7 8\n0 1 -2.5 0\n4 0 1 2 3\n3 0 1 3\n"},
        {"ply",
         "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "element tristrips 2\nproperty list int int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n1 1 0\n0 1 -2.5\n8 0 1 2 3 -1 0 1 3\n3 0 0 1\n"},
        {"ply", strips_ply()},
        {"ply", binary_ply(std::endian::little)},
        {"ply", binary_ply(std::endian::big)},
        {"stl",
         "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1e0 0\nendloop\nendfacet\n"
         "endsolid one\nsolid\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 1 0 vertex 0 1 0 endloop "
         "endfacet\nendsolid\n"},
        {"stl",
         "solid a b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1e0 0\nend loop\nend facet\n"
         "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 1 0 vertex 0 1 0 end loop endfacet\nend solid a b\n"},
        {"stl", binary_stl({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0})},
    };
}

}  // namespace pierce::test

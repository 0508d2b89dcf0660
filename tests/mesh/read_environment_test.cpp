// Reading gives the same bits in every floating-point environment.
//
// A binary PLY file with double coordinates was read into float by the caller's arithmetic. Where denormal numbers are
// flushed, which games and -ffast-math switch on, 1e-40 became 0, a face of that size lost its area, and particles fell
// through it; rounding upwards, 0.1 became the next float. Mesh and particles then stood on different coordinates than
// in the tool that wrote the file. The judges are the bits that the standard environment gives, and constants.
#include "read_test_support.h"

#include <sstream>

#include <support/setting.h>

namespace pierce {
namespace {

using test::put;
using test::TempFile;

template <class Scalar>
using Bits = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;

// The mesh as it was read; compared where nothing is flushed.
template <class Scalar>
std::vector<std::uint64_t> bits_of(const TriangleSoup<Scalar>& mesh) {
    std::vector<std::uint64_t> bits;
    for (const Vec3<Scalar>& position : mesh.positions) {
        for (int k = 0; k < 3; ++k) {
            bits.push_back(std::bit_cast<Bits<Scalar>>(position[k]));
        }
    }
    for (const IndexTriple& triangle : mesh.triangles) {
        bits.insert(bits.end(), triangle.begin(), triangle.end());
    }
    bits.insert(bits.end(), mesh.faces.begin(), mesh.faces.end());
    return bits;
}

template <class Scalar>
TriangleSoup<Scalar> read_in(const TempFile& file, int rounding, bool flush) {
    const test::Setting setting(rounding, flush);
    TriangleSoup<Scalar> mesh = read_mesh<Scalar>(file.path());
    setting.expect_given_back();
    return mesh;
}

template <class Scalar>
void expect_same_everywhere(const std::string& ending, const std::string& bytes) {
    SCOPED_TRACE(ending);
    const TempFile file(ending, bytes);
    const auto standard = bits_of(read_in<Scalar>(file, FE_TONEAREST, false));
    test::for_each_setting([&](int rounding, bool flush) {
        EXPECT_EQ(bits_of(read_in<Scalar>(file, rounding, flush)), standard)
            << "rounding " << rounding << " flush " << flush;
    });
}

std::string double_ply(const std::vector<double>& coordinates, std::endian order) {
    std::string bytes = std::string("ply\nformat binary_") + (order == std::endian::big ? "big" : "little") +
                        "_endian 1.0\nelement vertex " + std::to_string(coordinates.size() / 3) +
                        "\nproperty double x\nproperty double y\nproperty double z\nelement face 1\n"
                        "property list uchar uchar vertex_indices\nend_header\n";
    for (const double x : coordinates) {
        put(bytes, x, order);
    }
    put(bytes, static_cast<std::uint8_t>(coordinates.size() / 3));
    for (std::size_t i = 0; i < coordinates.size() / 3; ++i) {
        put(bytes, static_cast<std::uint8_t>(i));
    }
    return bytes;
}

TEST(ReadEnvironment, DoublesOfABinaryFileAreRoundedToNearestFloats) {
    const TempFile file("ply", double_ply({1e-40, 0.1, 0, 0.7, 1e-39, 3.3, 1.1, 1e-310, -5}, std::endian::little));
    test::for_each_setting([&](int rounding, bool flush) {
        const auto mesh = read_in<float>(file, rounding, flush);
        ASSERT_EQ(mesh.positions.size(), 3U);
        EXPECT_EQ(std::bit_cast<std::uint32_t>(mesh.positions[0][0]), 71362U) << "1e-40 / 2^-149 is 71362.4";
        EXPECT_EQ(std::bit_cast<std::uint32_t>(mesh.positions[0][1]), 0x3dcccccdU) << "0.1";
        EXPECT_EQ(std::bit_cast<std::uint32_t>(mesh.positions[1][0]), 0x3f333333U) << "0.7";
        EXPECT_EQ(std::bit_cast<std::uint32_t>(mesh.positions[2][1]), 0U) << "1e-310";
    });
}

TEST(ReadEnvironment, ChangesNoBitOfAnyFormat) {
    // Numbers between two floats, denormal ones, and a concave polygon with three corners that are on one line but for
    // a rounding, which other rounding modes would cut another way.
    const std::vector<double> pentagon = {0, 0, 0, 4, 0.1, 1e-39, 4.1, 4, 0.3, 2, 0.05, 1e-310, 0.1, 3.9, 1e-40};
    std::vector<float> floats(9);
    for (std::size_t i = 0; i < 9; ++i) {
        floats[i] = static_cast<float>(pentagon[i]);
    }
    std::string obj;
    std::string off = "OFF\n5 1 0\n";
    std::string stl = "solid s\nfacet normal 0 0 1\nouter loop\n";
    for (std::size_t i = 0; i < pentagon.size(); i += 3) {
        std::ostringstream line;
        line.precision(19);  // more digits than a double has
        line << pentagon[i] << ' ' << pentagon[i + 1] << ' ' << pentagon[i + 2] << '\n';
        obj += "v " + line.str();
        off += line.str();
        stl += i < 9 ? "vertex " + line.str() : "";
    }
    obj += "f 1 2 3 4 5\n";
    off += "5 0 1 2 3 4\n";
    stl += "endloop\nendfacet\nendsolid s\n";
    const std::vector<test::SmallFile> files = {{"obj", obj},
                                                {"off", off},
                                                {"stl", stl},
                                                {"stl", test::binary_stl(floats)},
                                                {"ply", double_ply(pentagon, std::endian::little)},
                                                {"ply", double_ply(pentagon, std::endian::big)}};
    for (const auto& [ending, bytes] : files) {
        expect_same_everywhere<float>(ending, bytes);
        expect_same_everywhere<double>(ending, bytes);
    }
    for (const auto& [ending, bytes] : test::small_files()) {
        expect_same_everywhere<float>(ending, bytes);
    }
}

std::string with_y(double y) { return double_ply({0, 0, 0, 1, 0, 0, 0, y, 0}, std::endian::little); }

TEST(ReadEnvironment, RefusesTheSameNumbersInTheSameWordsAndIsGivenBackThen) {
    // The largest float is 2^128 - 2^104. Up to half a step above it doubles are rounded down to it, from there on to
    // infinity.
    const double half_a_step = 0x1p128 - 0x1p103;
    const TempFile fits("ply", with_y(std::nextafter(half_a_step, 0.0)));
    const TempFile just_too_large("ply", with_y(half_a_step));
    const TempFile too_large("ply", with_y(1e40 / 3));
    const std::string standard = test::refusal_of<float>(too_large.path());
    EXPECT_NE(standard.find(" 3.3333333333333336e+39 "), std::string::npos) << standard;
    test::for_each_setting([&](int rounding, bool flush) {
        const test::Setting setting(rounding, flush);
        EXPECT_EQ(test::refusal_of<float>(fits.path()), "read");
        EXPECT_NE(test::refusal_of<float>(just_too_large.path()), "read");
        EXPECT_EQ(test::refusal_of<float>(too_large.path()), standard);
        setting.expect_given_back();
    });
}

}  // namespace
}  // namespace pierce

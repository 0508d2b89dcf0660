// Damaged files: cut short at every byte, with other counts, with other bytes. Whatever the damage, the reader throws
// `MeshError` or returns a mesh that is whole in itself; it never crashes, hangs, or asks for memory that the file does
// not justify.
#include "read_test_support.h"

#include <random>

namespace pierce {
namespace {

using test::small_files;
using test::SmallFile;

/// True if the file was read.
template <class Scalar>
bool read_or_refuse(const std::string& ending, const std::string& bytes, std::size_t* triangles = nullptr) {
    const test::TempFile file(ending, bytes);
    try {
        const auto mesh = read_mesh<Scalar>(file.path(), {.materials = true, .groups = true});
        test::expect_valid(mesh);
        if (triangles != nullptr) {
            *triangles = mesh.triangles.size();
        }
        return true;
    } catch (const MeshError& error) {
        EXPECT_TRUE(std::string_view(error.what()).starts_with(file.path().string()));
        EXPECT_EQ(std::string_view(error.what()).find_first_of("\r\n"), std::string_view::npos);
        return false;
    }
}

std::size_t occurrences(std::string_view text, std::string_view word) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
        ++count;
    }
    return count;
}

TEST(ReadDamage, TheFilesAreValidBeforeTheyAreDamaged) {
    for (const SmallFile& file : small_files()) {
        std::size_t triangles = 0;
        EXPECT_TRUE(read_or_refuse<double>(file.ending, file.bytes, &triangles)) << file.bytes;
        EXPECT_TRUE(read_or_refuse<float>(file.ending, file.bytes));
        EXPECT_GE(triangles, 2U);
    }
}

TEST(ReadDamage, CutShortAtEveryByte) {
    for (const SmallFile& file : small_files()) {
        std::size_t whole = 0;
        ASSERT_TRUE(read_or_refuse<double>(file.ending, file.bytes, &whole));
        for (std::size_t length = 0; length < file.bytes.size(); ++length) {
            const std::string part = file.bytes.substr(0, length);
            std::size_t triangles = 0;
            read_or_refuse<float>(file.ending, part);
            // An OBJ file may end anywhere. All others say how much they hold, or, as each solid of a text STL does,
            // where they end.
            if (read_or_refuse<double>(file.ending, part, &triangles) && file.ending != "obj") {
                EXPECT_EQ(triangles, file.bytes.starts_with("solid") ? occurrences(part, "facet normal") : whole)
                    << part;
            }
        }
    }
}

// Each number of a header, and each of the words in the body, becomes one that is too small, too large, or absurd.
TEST(ReadDamage, OtherCounts) {
    const std::vector<std::string> counts = {"0",
                                             "1",
                                             "2",
                                             "5",
                                             "-1",
                                             "127",
                                             "255",
                                             "1000000",
                                             "2147483647",
                                             "2147483648",
                                             "4294967295",
                                             "4294967296",
                                             "-2147483648",
                                             "18446744073709551615",
                                             "18446744073709551617",
                                             "99999999999999999999999999",
                                             "1e9",
                                             "nan",
                                             ""};
    for (const SmallFile& file : small_files()) {
        const bool is_binary = file.bytes.find('\0') != std::string::npos;
        const std::size_t header_end = file.bytes.find("end_header");
        for (std::size_t at = 0; at < file.bytes.size(); ++at) {
            const auto is_digit = [&](std::size_t i) {
                return i < file.bytes.size() && file.bytes[i] >= '0' && file.bytes[i] <= '9';
            };
            if (!is_digit(at) || (at > 0 && is_digit(at - 1)) || (is_binary && at > header_end)) {
                continue;
            }
            std::size_t length = 1;
            while (is_digit(at + length)) {
                ++length;
            }
            for (const std::string& count : counts) {
                std::string bytes = file.bytes;
                bytes.replace(at, length, count);
                read_or_refuse<double>(file.ending, bytes);
            }
        }
    }
}

TEST(ReadDamage, OtherBinaryCounts) {
    for (const SmallFile& file : small_files()) {
        if (file.bytes.find('\0') == std::string::npos) {
            continue;
        }
        for (std::size_t at = 0; at + 4 <= file.bytes.size(); ++at) {
            for (const std::uint32_t count :
                 {0U, 1U, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFFU, 0x01000000U, 0x0000FFFFU}) {
                std::string number;
                test::put(number, count);
                std::string bytes = file.bytes;
                bytes.replace(at, 4, number);
                read_or_refuse<double>(file.ending, bytes);
            }
        }
    }
}

TEST(ReadDamage, OtherBytes) {
    std::mt19937 random(1);
    constexpr int changes_of_each = 2000;
    const std::string_view likely = "0123456789+-.eE \t\n\r\\/#vfnaidx\0\xFF\x7F\x80";
    for (const SmallFile& file : small_files()) {
        for (int i = 0; i < changes_of_each; ++i) {
            std::string bytes = file.bytes;
            const std::uint32_t changes = 1 + random() % 4;
            for (std::uint32_t k = 0; k < changes && !bytes.empty(); ++k) {
                const std::size_t at = random() % bytes.size();
                const char c = random() % 2 == 0 ? static_cast<char>(random() % 256) : likely[random() % likely.size()];
                switch (random() % 4) {
                    case 0:
                        bytes.erase(at, 1 + random() % 3);
                        break;
                    case 1:
                        bytes.insert(at, 1 + random() % 3, c);
                        break;
                    case 2:
                        bytes[at] = static_cast<char>(bytes[at] ^ (1 << (random() % 8)));
                        break;
                    default:
                        bytes[at] = c;
                        break;
                }
            }
            if (i % 2 == 0) {
                read_or_refuse<float>(file.ending, bytes);
            } else {
                read_or_refuse<double>(file.ending, bytes);
            }
        }
    }
}

}  // namespace
}  // namespace pierce

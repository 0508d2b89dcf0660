// See checkpoint.h. The file is an array of 64-bit words in the machine's byte order: a head, the tallies, and a hash
// of all that comes before it.
#include "mpi_tracking/checkpoint.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pierce/version.h>

namespace tracking {

namespace {

using Word = std::uint64_t;

// "mpchec" and the number of the format, to be raised where tallies or physics mean something else. On a machine of the
// other byte order it is another number.
constexpr Word k_magic = 0x6b63'6568'6370'6d01;
constexpr std::size_t k_hash = 2;  // words, at the end

/// The head in the order of the file, each word with what it says, for messages. The first two are checked before all.
std::vector<std::pair<const char*, Word>> head_of(const RunIdentity& run, std::size_t words) {
    constexpr Word version =
        1'000'000 * PIERCE_VERSION_MAJOR + 1'000 * PIERCE_VERSION_MINOR + Word{PIERCE_VERSION_PATCH};
    return {{"format", k_magic},
            {"length", words},
            {"version of pierce", version},
            {"mesh", run.mesh.low},
            {"mesh", run.mesh.high},
            {"--seed", run.physics.seed},
            {"--stick", std::bit_cast<Word>(run.physics.sticking)},
            {"--most-hits", run.physics.most_hits}};
}

std::size_t head_words() { return head_of({}, 0).size(); }

std::array<Word, k_hash> hash_of(const std::vector<Word>& words, std::size_t count) {
    Hash hash;
    std::for_each_n(words.begin(), count, [&hash](Word word) { hash.add(word); });
    return {hash.low, hash.high};
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
    throw std::runtime_error(path.string() + ": " + why);
}

/// A file descriptor. What has been written is on the disk when `sync` returns.
class File {
  public:
    File(std::filesystem::path path, int flags) : path_(std::move(path)), file_(open(path_.c_str(), flags, 0666)) {
        if (file_ < 0) fail("can't be opened");
    }
    ~File() { close(file_); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    void write(const char* bytes, std::size_t size) {
        while (size > 0) {
            const ssize_t written = ::write(file_, bytes, size);
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) fail("can't be written");
            bytes += written;
            size -= static_cast<std::size_t>(written);
        }
    }
    void sync() {
        if (fsync(file_) != 0 && errno != EINVAL) fail("can't be written");  // EINVAL: there is no disk behind it
    }

  private:
    void fail(const char* what) { refuse(path_, std::string(what) + " (" + std::strerror(errno) + ")"); }

    std::filesystem::path path_;
    int file_;
};

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const RunIdentity& run, const Tallies& tallies) {
    std::vector<Word> words;
    words.reserve(head_words() + tallies.words().size() + k_hash);
    for (const auto& [name, word] : head_of(run, words.capacity())) words.push_back(word);
    words.insert(words.end(), tallies.words().begin(), tallies.words().end());
    for (const Word word : hash_of(words, words.size())) words.push_back(word);

    const std::filesystem::path unfinished = path.string() + ".new";
    {
        File file(unfinished, O_WRONLY | O_CREAT | O_TRUNC);
        file.write(reinterpret_cast<const char*>(words.data()), words.size() * sizeof(Word));
        file.sync();  // before the new name, which must not be there without what it names
    }
    std::filesystem::rename(unfinished, path);
    const std::filesystem::path folder = path.parent_path();
    File(folder.empty() ? "." : folder, O_RDONLY).sync();
}

std::optional<Tallies> read_checkpoint(const std::filesystem::path& path, const RunIdentity& run, std::size_t faces) {
    if (!std::filesystem::exists(path)) return std::nullopt;
    std::ifstream file(path, std::ios::binary);
    const std::size_t bytes = std::filesystem::is_regular_file(path) ? std::filesystem::file_size(path) : 0;
    std::vector<Word> words(bytes / sizeof(Word));
    if (!file.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * sizeof(Word))))
        refuse(path, "can't be read");

    if (words.empty() || words[0] != k_magic) refuse(path, "is no checkpoint");
    if (words.size() < head_words() || bytes != words[1] * sizeof(Word)) refuse(path, "is cut short, or too long");
    const std::array<Word, k_hash> hash = hash_of(words, words.size() - k_hash);
    if (!std::equal(hash.begin(), hash.end(), words.end() - k_hash)) refuse(path, "is damaged: its hash does not fit");

    // From here on it is as it was written.
    const auto head = head_of(run, words.size());
    for (std::size_t i = 0; i < head.size(); ++i)
        if (words[i] != head[i].second) refuse(path, "is of another run: it differs in " + std::string(head[i].first));
    Tallies tallies(faces);
    if (words.size() != head.size() + tallies.words().size() + k_hash) refuse(path, "is of another number of faces");
    std::copy_n(words.begin() + static_cast<std::ptrdiff_t>(head.size()), tallies.words().size(),
                tallies.words().begin());
    return tallies;
}

}  // namespace tracking

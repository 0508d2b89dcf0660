// The C++ side of the comparison: asks batches and says how long each took, one for each line of its input.
//   python_batch_server FILE       FILE: as in tests/python/dump.cpp, in double
// A line is KIND COUNT; the answer is the seconds that the thread ran, memory for the answers with them, and the hits.
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <pierce/pierce.h>

namespace {

using namespace pierce;
using Scalar = double;

template <class Value>
std::vector<Value> read(std::istream& in, std::uint64_t count) {
    std::vector<Value> values(count);
    in.read(static_cast<char*>(static_cast<void*>(values.data())), static_cast<std::streamsize>(count * sizeof(Value)));
    return values;
}

// Not set, as NumPy's are not.
template <class Value>
std::unique_ptr<Value[]> room(std::size_t count) {
    return std::make_unique_for_overwrite<Value[]>(count);
}

// That the thread was running for, as Python's time.thread_time().
double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

class Server {
  public:
    explicit Server(std::istream&& in)
        : sizes_(read<std::uint64_t>(in, 3)),
          vertices_(read<Vec3<Scalar>>(in, sizes_[0])),
          faces_(read<IndexTriple>(in, sizes_[1])),
          starts_(read<Vec3<Scalar>>(in, sizes_[2])),
          ends_(read<Vec3<Scalar>>(in, sizes_[2])),
          mesh_({vertices_, faces_}) {
        if (!in) std::exit(2);
    }

    std::size_t ask(const std::string& kind, std::size_t count) const {
        const PointsView<Scalar> starts = PointsView<Scalar>(starts_).part(0, count);
        const Segments<Scalar> segments(starts, PointsView<Scalar>(ends_).part(0, count));
        if (kind == "contains") {
            const auto out = room<std::uint8_t>(count);
            return mesh_.contains_points(starts, {out.get(), count});
        }
        if (kind == "any_hits") {
            const auto out = room<std::uint8_t>(count);
            return mesh_.any_hits(segments, {out.get(), count});
        }
        HitArrays<Scalar> arrays;
        arrays.count = count;
        const auto hit = room<std::uint8_t>(count);
        const auto fraction = room<Scalar>(count);
        const auto face = room<std::uint32_t>(count);
        arrays.hit = hit.get();
        arrays.fraction = fraction.get();
        arrays.face = face.get();
        if (kind == "first_hits.few") return mesh_.first_hits(segments, arrays);
        if (kind != "first_hits.all") std::exit(2);
        const auto exact_fraction = room<Scalar>(count);
        const auto point = room<Scalar>(3 * count);
        const auto position = room<Scalar>(3 * count);
        const auto normal = room<Scalar>(3 * count);
        const auto barycentric = room<Scalar>(3 * count);
        const auto triangle = room<std::uint32_t>(count);
        const auto side = room<Sides>(count);
        const auto feature = room<Feature>(count);
        const auto feature_index = room<std::uint8_t>(count);
        const auto at_start = room<std::uint8_t>(count);
        arrays.exact_fraction = exact_fraction.get();
        arrays.point = point.get();
        arrays.position = position.get();
        arrays.normal = normal.get();
        arrays.barycentric = barycentric.get();
        arrays.triangle = triangle.get();
        arrays.side = side.get();
        arrays.feature = feature.get();
        arrays.feature_index = feature_index.get();
        arrays.at_start = at_start.get();
        return mesh_.first_hits(segments, arrays);
    }

  private:
    std::vector<std::uint64_t> sizes_;
    std::vector<Vec3<Scalar>> vertices_;
    std::vector<IndexTriple> faces_;
    std::vector<Vec3<Scalar>> starts_;
    std::vector<Vec3<Scalar>> ends_;
    CollisionMesh<Scalar> mesh_;
};

}  // namespace

int main(int count, char** words) {
    if (count != 2) return std::cerr << "python_batch_server FILE\n", 2;
    const Server server(std::ifstream(words[1], std::ios::binary));
    std::cout << "ready" << std::endl;
    std::cout.precision(17);
    std::string kind;
    for (std::size_t number = 0; std::cin >> kind >> number;) {
        const double start = thread_seconds();
        const std::size_t hits = server.ask(kind, number);
        std::cout << thread_seconds() - start << ' ' << hits << std::endl;
    }
}

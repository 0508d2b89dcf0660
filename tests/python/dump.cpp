// What the C++ interface answers, byte by byte, for tests/python to compare with:
//   python_dump float|double KIND INPUT OUTPUT
// INPUT: the numbers of vertices, faces and queries (64 bits each), vertices, faces, and two points for each query.
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pierce/pierce.h>

namespace {

using namespace pierce;

template <class Scalar>
struct Given {
    std::vector<Vec3<Scalar>> vertices;
    std::vector<IndexTriple> faces;
    std::vector<Vec3<Scalar>> starts;
    std::vector<Vec3<Scalar>> ends;

    explicit Given(const char* path) {
        std::ifstream in(path, std::ios::binary);
        std::uint64_t sizes[3] = {};
        read(in, sizes, 3);
        vertices.resize(sizes[0]), faces.resize(sizes[1]), starts.resize(sizes[2]), ends.resize(sizes[2]);
        read(in, vertices.data(), vertices.size());
        read(in, faces.data(), faces.size());
        read(in, starts.data(), starts.size());
        read(in, ends.data(), ends.size());
        if (!in) std::exit(2);
    }
    template <class Value>
    static void read(std::istream& in, Value* values, std::size_t count) {
        in.read(static_cast<char*>(static_cast<void*>(values)), static_cast<std::streamsize>(count * sizeof(Value)));
    }
};

class Out {
  public:
    explicit Out(const char* path) : out_(path, std::ios::binary) {}
    template <class Value>
    void all(const std::vector<Value>& values) {
        out_.write(static_cast<const char*>(static_cast<const void*>(values.data())),
                   static_cast<std::streamsize>(values.size() * sizeof(Value)));
    }
    // Members one after the other: a miss is zeros.
    template <class Answer, class... Members>
    void members(const std::vector<Answer>& answers, Members... members) {
        for (const Answer& answer : answers) (member(answer.*members), ...);
    }
    bool good() { return static_cast<bool>(out_.flush()); }

  private:
    template <class Value>
    void member(const Value& value) {
        out_.write(static_cast<const char*>(static_cast<const void*>(&value)), sizeof value);
    }
    std::ofstream out_;
};

template <class Hit>
std::vector<Hit> without_misses(const std::vector<std::optional<Hit>>& hits) {
    std::vector<Hit> some;
    for (const auto& hit : hits)
        if (hit) some.push_back(*hit);
    return some;
}

template <class Scalar, class Answer>
void sweeps(Out& out, const std::vector<std::optional<Answer>>& hits) {
    out.members(without_misses(hits), &Answer::time, &Answer::place, &Answer::position, &Answer::normal,
                &Answer::barycentric, &Answer::surface_motion, &Answer::face, &Answer::triangle, &Answer::side,
                &Answer::feature, &Answer::feature_index, &Answer::at_start, &Answer::place_verified);
}

template <class Scalar>
int run(const std::string& kind, const char* input, const char* output) {
    const Given<Scalar> given(input);
    const CollisionMesh<Scalar> mesh({given.vertices, given.faces});
    const Segments<Scalar> segments(given.starts, given.ends);
    const Rays<Scalar> rays(given.starts, given.ends, Scalar{2});
    const std::size_t n = segments.size();
    Out out(output);
    std::vector<Hit<Scalar>> hits(n);
    std::vector<std::uint8_t> flags(n);
    std::vector<int> numbers(n);
    std::vector<std::size_t> offsets(n + 1);
    const auto moved = [&](auto move) {
        using M = Move<Scalar>;
        std::vector<M> moves(n);
        move(moves);
        out.members(moves, &M::position, &M::velocity, &M::travel, &M::remainder, &M::contacts, &M::casts, &M::state);
    };
    MoveOptions<Scalar> options;
    options.response = {.restitution = Scalar{0.5}, .friction = Scalar{0.25}};
    const std::map<std::string, std::function<void()>> kinds = {
        {"first", [&] { mesh.first_hits(segments, hits), out.all(hits); }},
        {"both", [&] { mesh.first_hits(segments, hits, {.sides = Sides::both}), out.all(hits); }},
        {"rays", [&] { mesh.first_hits(rays, hits), out.all(hits); }},
        {"any", [&] { mesh.any_hits(segments, flags), out.all(flags); }},
        {"any_rays", [&] { mesh.any_hits(rays, flags), out.all(flags); }},
        {"all",
         [&] {
             hits.resize(mesh.all_hits(segments, offsets, {}));
             mesh.all_hits(segments, offsets, hits);
             out.all(offsets), out.all(hits);
         }},
        {"contains", [&] { mesh.contains_points(given.starts, flags), out.all(flags); }},
        {"winding", [&] { mesh.winding_numbers(given.starts, numbers), out.all(numbers); }},
        {"crossings", [&] { mesh.crossings(segments, numbers), out.all(numbers); }},
        {"crossings_rays", [&] { mesh.crossings(rays, numbers), out.all(numbers); }},
        {"spheres",
         [&] {
             std::vector<std::optional<SphereHit<Scalar>>> spheres(n);
             mesh.sweep_spheres(segments, Scalar{0.125}, spheres);
             out.all(without_misses(spheres));
         }},
        {"straight",
         [&] {
             std::vector<std::optional<SweepHit<Scalar>>> swept(n);
             const Translation<Scalar> motion{{0, 0, 0}, {Scalar{0.25}, 0, Scalar{-0.5}}};
             mesh.sweeps(segments, motion, std::span(swept));
             sweeps<Scalar>(out, swept);
         }},
        {"turning",
         [&] {
             std::vector<std::optional<RigidHit<Scalar>>> swept(n);
             Pose<double> end;
             end.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
             end.translation << 0.25, 0, 0;
             mesh.sweeps(segments, RigidMotion({}, end, 0.01), std::span(swept));
             sweeps<Scalar>(out, swept);
         }},
        {"deforming",
         [&] {
             DeformingMesh<Scalar> deforming({given.vertices, given.faces});
             auto positions = given.vertices;
             for (auto& position : positions) position[2] *= Scalar{0.5};
             deforming.begin_step(positions);
             std::vector<std::optional<SweepHit<Scalar>>> swept(n);
             deforming.sweeps(segments, swept);
             sweeps<Scalar>(out, swept);
         }},
        {"slide",
         [&] {
             moved([&](auto& moves) { moves_and_slide<Scalar>(mesh, given.starts, given.ends, Scalar{0.5}, moves); });
         }},
        {"bounce",
         [&] {
             moved([&](auto& moves) {
                 moves_and_bounce<Scalar>(mesh, given.starts, given.ends, Scalar{0.5}, moves, options);
             });
         }},
    };
    kinds.at(kind)();
    return out.good() ? 0 : 2;
}

}  // namespace

int main(int count, char** words) {
    if (count != 5) return std::fputs("python_dump float|double KIND INPUT OUTPUT\n", stderr), 2;
    return std::string(words[1]) == "float" ? run<float>(words[2], words[3], words[4])
                                            : run<double>(words[2], words[3], words[4]);
}

// From hits that were found in a world to hits that are answered: their order, their values, and their verified points.
#pragma once

#include <query/report.h>
#include <world/order.h>
#include <world/ways.h>

namespace pierce::detail {

/// Writes a hit. `passed(index, triangle)` says which triangles are hit strictly before it.
template <class Scalar, class Passed>
void answer(const WorldScene<Scalar>& world, const Path& path, const OwnHit& own, const Passed& passed,
            const WorldOptions& options, QueryCounters& counters, WorldHit<Scalar>& out) {
    const Instance<Scalar>& instance = world.instances[own.index];
    const Scene<Scalar>& scene = *instance.scene;
    const Candidate& candidate = own.candidate;
    Hit<Scalar>& hit = out.hit;
    Values values;
    Rounded<Scalar> rounded;
    certify(scene.narrow(), candidate.measured, own.local, candidate.decision, instance.grain, counters, values,
            rounded);
    if (path.ray) {
        const double parameter = to_parameter(own.local, values.weights[3], candidate.decision.at_start,
                                              [&] { return corners_of(candidate.measured); });
        rounded.weights[3] =
            static_cast<Scalar>(std::min(parameter, static_cast<double>(std::numeric_limits<Scalar>::max())));
    }
    const std::uint32_t number = scene.number_of(candidate.triangle);
    report(rounded, candidate.decision, scene.face_of_number(number), number, hit);
    out.mesh = world.id_of(own.index);
    const WorldWays<Scalar, Passed> ways(world, path, own, values, passed, options, counters);
    const int tries =
        place(own.local, candidate.measured, candidate.decision, instance.grain, values, rounded, counters, ways, hit);
    counters.retreats += static_cast<std::uint64_t>(tries);
    if (instance.still()) return;
    // The last way that was clear is that to the hit's point; there is none to the start.
    const Point& point = to_point(hit.point.vec()) == own.local.from ? path.from : ways.chosen();
    if (point == path.from) hit.fraction = 0;
    hit.point = to_vector<Scalar>(point);
    hit.position = to_vector<Scalar>(out_of(instance.placement, to_point(hit.position.vec())));
    if (instance.placement.stand == Stand::turned)
        hit.normal = to_vector<Scalar>(turned(instance.placement, to_point(hit.normal.vec())));
}

/// Counts every hit and keeps the first ones in `out`, as `All` does. Of each it fills what it needs itself: the mesh,
/// the place of the triangle (cluster in `triangle`, lane in `face`), feature, side, at_start and exact_fraction.
template <class Scalar>
class Ranking {
  public:
    Ranking(const WorldScene<Scalar>& world, const Path& path, std::span<WorldHit<Scalar>> out, QueryCounters& counters)
        : world_(world), path_(path), out_(out), counters_(counters) {}

    /// `local`: the path in that mesh.
    void add(std::uint32_t index, const Path& local, const Candidate& candidate) {
        ++total_;
        if (out_.empty()) return;
        if (kept_ < out_.size()) {
            write(index, local, candidate, out_[kept_++]);
            std::push_heap(out_.begin(), end(), before());
        } else if (is_before({index, candidate}, out_[0])) {
            std::pop_heap(out_.begin(), end(), before());
            write(index, local, candidate, out_.back());
            std::push_heap(out_.begin(), end(), before());
        }
    }
    void sort() { std::sort_heap(out_.begin(), end(), before()); }
    [[nodiscard]] std::size_t total() const { return total_; }
    [[nodiscard]] std::span<WorldHit<Scalar>> kept() const { return out_.first(kept_); }

    [[nodiscard]] static Candidate candidate_of(const WorldHit<Scalar>& hit) {
        return All<Scalar>::candidate_of(hit.hit);
    }

  private:
    [[nodiscard]] auto end() const { return out_.begin() + static_cast<std::ptrdiff_t>(kept_); }
    [[nodiscard]] bool is_before(const Found& found, const WorldHit<Scalar>& hit) const {
        const Candidate other = candidate_of(hit);
        return comes_before(world_, path_, found, {hit.mesh.index, other}, counters_);
    }
    [[nodiscard]] auto before() const {
        return [this](const WorldHit<Scalar>& x, const WorldHit<Scalar>& y) {
            const Candidate candidate = candidate_of(x);
            return is_before({x.mesh.index, candidate}, y);
        };
    }
    void write(std::uint32_t index, const Path& local, const Candidate& candidate, WorldHit<Scalar>& out) const {
        out.mesh = world_.id_of(index);
        All<Scalar>::keep(*world_.instances[index].scene, local, candidate, counters_, out.hit);
    }

    const WorldScene<Scalar>& world_;
    const Path& path_;
    std::span<WorldHit<Scalar>> out_;
    QueryCounters& counters_;
    std::size_t total_ = 0;
    std::size_t kept_ = 0;
};

/// Writes the hits that were kept, in order.
template <class Scalar>
void answer_all(const WorldScene<Scalar>& world, const Path& path, const Ranking<Scalar>& ranking,
                const WorldOptions& options, QueryCounters& counters) {
    const std::span<WorldHit<Scalar>> hits = ranking.kept();
    Candidate last;
    std::uint32_t last_index = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const std::uint32_t index = hits[i].mesh.index;
        const Instance<Scalar>& instance = world.instances[index];
        Candidate candidate = Ranking<Scalar>::candidate_of(hits[i]);
        Path local;
        if (!set_local_path(instance, path, local)) continue;  // not where a hit was found
        // Hits that count and come strictly before. One that `accept` refuses on the way to `to` may count on the way
        // to the point.
        const auto passed = [&](std::uint32_t in, TriangleRef triangle) {
            const Instance<Scalar>& other = world.instances[in];
            Path there;
            Candidate met;
            if (!set_local_path(other, path, there)) return false;
            if (!Certified::test(*other.scene, triangle, there, options.sides, 1, counters, met)) return false;
            const QueryOptions here = options_in(options, world.id_of(in));
            if (here.accept && !accepted(*other.scene, there, triangle, met.decision, met.measured, here, counters))
                return false;
            return compare_exactly(world, path, {in, met}, {index, candidate}, counters) < 0;
        };
        measure_path<Scalar>(instance.scene->corners(candidate.triangle), local, candidate.measured);
        answer(world, path, {index, local, candidate, nullptr}, passed, options, counters, hits[i]);
        // As in query/engine.cpp, where it says why this keeps each within 1 ulp.
        if (i > 0) {
            const Scalar so_far = hits[i - 1].hit.exact_fraction;
            const bool equal = compare_exactly(world, path, {last_index, last}, {index, candidate}, counters) == 0;
            hits[i].hit.exact_fraction = equal ? so_far : std::max(so_far, hits[i].hit.exact_fraction);
        }
        last = candidate;
        last_index = index;
    }
}

}  // namespace pierce::detail

// Batches: queries in flight through the tree; one after the other where there is no tree, or one too deep for that.
#include <query/engine.h>

#include <memory>
#include <type_traits>

#include <query/answer.h>

namespace pierce::detail {

namespace {

/// A batch of one kind of query. `Query` is the state of one in flight:
///   Query(batch, i)       for query i
///   path, collector       as traverse() takes them
///   finish(batch)         writes the answer
template <class Scalar>
struct Batch {
    const Scene<Scalar>& scene;
    const Ends<Scalar>& ends;
    std::size_t next;
    std::size_t last;
    const QueryOptions& options;
    QueryCounters& counters;
    std::size_t& invalid;
    std::size_t hits = 0;

    /// The ends of query i; false where one is not finite, which counts as invalid.
    bool read_path(std::size_t i, Path& path) {
        if (!is_finite(ends, i)) {
            ++invalid;
            return false;
        }
        const auto at = static_cast<std::ptrdiff_t>(i);
        path.most = options.max_fraction;
        for (std::size_t k = 0; k < 3; ++k) {
            path.from[k] = static_cast<double>(ends.from[at * ends.from_stride + static_cast<std::ptrdiff_t>(k)]);
            path.to[k] = static_cast<double>(ends.to[at * ends.to_stride + static_cast<std::ptrdiff_t>(k)]);
        }
        return true;
    }
};

template <class Scalar, class Answer>
struct FirstQuery {
    using Out = std::optional<Answer>;

    FirstQuery(const Batch<Scalar>& batch, const Path& whole, Out& answer)
        : path(whole), collector(batch.scene, path, batch.counters), out(answer) {}
    FirstQuery(const FirstQuery&) = delete;
    FirstQuery& operator=(const FirstQuery&) = delete;

    void finish(Batch<Scalar>& batch) {
        if (!collector.found()) return;
        ++batch.hits;
        Answer& hit = out.emplace();
        answer<Certified, Scalar>(batch.scene, path, collector.best(), none_passed, batch.options, batch.counters,
                                  &collector.list(), hit);
        if constexpr (std::is_same_v<Answer, SweepHit<Scalar>>) hit.time_of_impact = hit.fraction;
    }

    Path path;
    First<Scalar> collector;
    Out& out;
};

template <class Scalar>
struct AnyQuery {
    using Out = std::uint8_t;

    AnyQuery(const Batch<Scalar>&, const Path& whole, Out& answer) : path(whole), collector(none_passed), out(answer) {}

    void finish(Batch<Scalar>& batch) {
        out = collector.found() ? 1 : 0;
        batch.hits += out;
    }

    Path path;
    Any<bool (*)(TriangleRef)> collector;
    Out& out;
};

/// Makes an answer empty without a look at what it was: that waits for memory, 8 % of the time of a batch.
template <class Out>
void clear(Out& out) {
    static_assert(std::is_trivially_destructible_v<Out>);
    std::construct_at(&out);
}

template <class Query, class Scalar>
void one_by_one(Batch<Scalar>& batch, typename Query::Out* out) {
    for (; batch.next < batch.last; ++batch.next) {
        Path path;
        clear(out[batch.next]);
        if (!batch.read_path(batch.next, path)) continue;
        Query query(batch, path, out[batch.next]);
        traverse<Certified>(batch.scene, query.path, batch.options, batch.counters, query.collector);
        query.finish(batch);
    }
}

template <class Query, class Scalar>
class InFlight {
  public:
    InFlight(Batch<Scalar>& batch, typename Query::Out* out) : batch_(batch), out_(out) {}

    void run() {
        const Scene<Scalar>& scene = batch_.scene;
        const Flight<Scalar> flight{this,
                                    [](void* self, unsigned slot, Probe<Scalar>& probe, float& limit) {
                                        return static_cast<InFlight*>(self)->start(slot, probe, limit);
                                    },
                                    [](void* self, unsigned slot, std::uint32_t cluster, unsigned lanes) {
                                        return static_cast<InFlight*>(self)->visit(slot, cluster, lanes);
                                    },
                                    [](void* self, unsigned slot) { static_cast<InFlight*>(self)->finish(slot); }};
        scene.backend->template of<Scalar>().fly(scene.tree.view(), scene.clusters.records.data(), flight);
    }

  private:
    struct Slot {
        std::optional<Query> query;
        const Probe<Scalar>* probe;
        float limit;
    };

    bool start(unsigned at, Probe<Scalar>& probe, float& limit) {
        Slot& slot = slots_[at];
        const QueryOptions& options = batch_.options;
        while (batch_.next < batch_.last) {
            const std::size_t i = batch_.next++;
            Path path;
            clear(out_[i]);
            if (!batch_.read_path(i, path)) continue;
            if (!make_probe(batch_.scene, path, options.sides, std::min(1.0, path.most), probe, limit))
                continue;
            slot.query.emplace(batch_, path, out_[i]);
            slot.probe = &probe;
            slot.limit = limit;
            return true;
        }
        return false;
    }

    float visit(unsigned at, std::uint32_t cluster, unsigned lanes) {
        Slot& slot = slots_[at];
        Query& query = *slot.query;
        return slot.limit = use_cluster(batch_.scene, *slot.probe, cluster, lanes, slot.limit, batch_.counters,
                                        [&](ClusterRef which, unsigned bits) {
                                            return test_cluster<Certified>(batch_.scene, query.path, which, bits,
                                                                           batch_.options, batch_.counters,
                                                                           query.collector);
                                        });
    }

    void finish(unsigned at) {
        Slot& slot = slots_[at];
        batch_.counters.nodes += slot.probe->nodes;
        batch_.counters.clusters += slot.probe->clusters;
        slot.query->finish(batch_);
    }

    Batch<Scalar>& batch_;
    typename Query::Out* out_;
    std::array<Slot, k_flights> slots_;
};

template <class Query, class Scalar>
std::size_t run(Batch<Scalar> batch, typename Query::Out* out) {
    const bool flies =
        !batch.scene.empty() && batch.scene.broadphase == Broadphase::tree && batch.scene.tree.depth <= k_flight_depth;
    if (flies)
        InFlight<Query, Scalar>(batch, out).run();
    else
        one_by_one<Query>(batch, out);
    return batch.hits;
}

}  // namespace

template <class Scalar, class Answer>
std::size_t first_hits(const Scene<Scalar>& scene, const Ends<Scalar>& ends, std::size_t first, std::size_t last,
                       std::optional<Answer>* out, const QueryOptions& options, QueryCounters& counters,
                       std::size_t& invalid) {
    return run<FirstQuery<Scalar, Answer>>(Batch<Scalar>{scene, ends, first, last, options, counters, invalid}, out);
}

template <class Scalar>
std::size_t any_hits(const Scene<Scalar>& scene, const Ends<Scalar>& ends, std::size_t first, std::size_t last,
                     std::uint8_t* out, const QueryOptions& options, QueryCounters& counters, std::size_t& invalid) {
    return run<AnyQuery<Scalar>>(Batch<Scalar>{scene, ends, first, last, options, counters, invalid}, out);
}

#define PIERCE_BATCHES(Scalar, Answer)                                                                   \
    template std::size_t first_hits(const Scene<Scalar>&, const Ends<Scalar>&, std::size_t, std::size_t, \
                                    std::optional<Answer>*, const QueryOptions&, QueryCounters&, std::size_t&)
PIERCE_BATCHES(float, Hit<float>);
PIERCE_BATCHES(float, SweepHit<float>);
PIERCE_BATCHES(double, Hit<double>);
PIERCE_BATCHES(double, SweepHit<double>);
#undef PIERCE_BATCHES
template std::size_t any_hits(const Scene<float>&, const Ends<float>&, std::size_t, std::size_t, std::uint8_t*,
                              const QueryOptions&, QueryCounters&, std::size_t&);
template std::size_t any_hits(const Scene<double>&, const Ends<double>&, std::size_t, std::size_t, std::uint8_t*,
                              const QueryOptions&, QueryCounters&, std::size_t&);

}  // namespace pierce::detail

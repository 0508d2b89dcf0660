// Batches: queries in flight through the tree; one after the other where there is no tree, or one too deep for that.
#include <query/engine.h>

#include <type_traits>

#include <query/answer.h>
#include <query/sinks.h>

namespace pierce::detail {

namespace {

/// A batch of one kind of query. `Query` is the state of one in flight:
///   Query(batch, path, sink, i)   for query i, whose answer goes to `sink` (sinks.h)
///   path, collector               as traverse() takes them
///   finish(batch)                 writes the answer
template <class Scalar>
struct Batch {
    const Scene<Scalar>& scene;
    const Ways<Scalar>& ways;
    std::size_t next;
    std::size_t last;
    const QueryOptions& options;
    QueryCounters& counters;
    std::size_t& invalid;
    std::size_t hits = 0;

    /// The path of query i; false where it has none. One that is not valid counts as invalid.
    bool read_path(std::size_t i, Path& path) {
        if (ways.is_valid(i)) return ways.set_path(scene, i, options.max_fraction, path);
        ++invalid;
        return false;
    }
};

template <class Scalar, class Answers>
struct FirstQuery {
    using Sink = Answers;

    FirstQuery(const Batch<Scalar>& batch, const Path& whole, const Sink& answers, std::size_t i)
        : path(whole), collector(batch.scene, path, batch.counters), sink(answers), number(i) {}
    FirstQuery(const FirstQuery&) = delete;
    FirstQuery& operator=(const FirstQuery&) = delete;

    void finish(Batch<Scalar>& batch) {
        if (!collector.found()) return;
        ++batch.hits;
        sink.put(number, [&](Hit<Scalar>& hit) {
            answer<Certified, Scalar>(batch.scene, path, collector.best(), none_passed, batch.options, batch.counters,
                                      &collector.list(), hit);
        });
    }

    Path path;
    First<Scalar> collector;
    const Sink& sink;
    std::size_t number;
};

template <class Scalar>
struct AnyQuery {
    using Sink = AnyAnswers;

    AnyQuery(const Batch<Scalar>&, const Path& whole, const Sink& answers, std::size_t i)
        : path(whole), collector(none_passed), out(answers.out[i]) {}

    void finish(Batch<Scalar>& batch) {
        out = collector.found() ? 1 : 0;
        batch.hits += out;
    }

    Path path;
    Any<bool (*)(TriangleRef)> collector;
    std::uint8_t& out;
};

template <class Query, class Scalar>
void one_by_one(Batch<Scalar>& batch, const typename Query::Sink& sink) {
    for (; batch.next < batch.last; ++batch.next) {
        Path path;
        sink.clear(batch.next);
        if (!batch.read_path(batch.next, path)) continue;
        Query query(batch, path, sink, batch.next);
        traverse<Certified>(batch.scene, query.path, batch.options, batch.counters, query.collector);
        query.finish(batch);
    }
}

template <class Query, class Scalar>
class InFlight {
  public:
    InFlight(Batch<Scalar>& batch, const typename Query::Sink& sink) : batch_(batch), sink_(sink) {}

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
            sink_.clear(i);
            if (!batch_.read_path(i, path)) continue;
            if (!make_probe(batch_.scene, path, options.sides, std::min(1.0, path.most), probe, limit)) continue;
            slot.query.emplace(batch_, path, sink_, i);
            slot.probe = &probe;
            slot.limit = limit;
            return true;
        }
        return false;
    }

    float visit(unsigned at, std::uint32_t cluster, unsigned lanes) {
        Slot& slot = slots_[at];
        Query& query = *slot.query;
        return slot.limit =
                   use_cluster(batch_.scene, *slot.probe, cluster, lanes, slot.limit, batch_.counters,
                               [&](ClusterRef which, unsigned bits) {
                                   return test_cluster<Certified>(batch_.scene, query.path, which, bits, batch_.options,
                                                                  batch_.counters, query.collector);
                               });
    }

    void finish(unsigned at) {
        Slot& slot = slots_[at];
        batch_.counters.nodes += slot.probe->nodes;
        batch_.counters.clusters += slot.probe->clusters;
        slot.query->finish(batch_);
    }

    Batch<Scalar>& batch_;
    const typename Query::Sink& sink_;
    std::array<Slot, k_flights> slots_;
};

template <class Query, class Scalar>
std::size_t run(Batch<Scalar> batch, const typename Query::Sink& sink) {
    if (takes_flights(batch.scene))
        InFlight<Query, Scalar>(batch, sink).run();
    else
        one_by_one<Query>(batch, sink);
    return batch.hits;
}

}  // namespace

template <class Scalar>
std::size_t first_hits(const Scene<Scalar>& scene, const Ways<Scalar>& ways, std::size_t first, std::size_t last,
                       const HitsOut<Scalar>& out, const QueryOptions& options, QueryCounters& counters,
                       std::size_t& invalid) {
    return with_sink(out, [&](const auto& sink) {
        return run<FirstQuery<Scalar, std::decay_t<decltype(sink)>>>(
            Batch<Scalar>{scene, ways, first, last, options, counters, invalid}, sink);
    });
}

template <class Scalar>
std::size_t any_hits(const Scene<Scalar>& scene, const Ways<Scalar>& ways, std::size_t first, std::size_t last,
                     std::uint8_t* out, const QueryOptions& options, QueryCounters& counters, std::size_t& invalid) {
    return run<AnyQuery<Scalar>>(Batch<Scalar>{scene, ways, first, last, options, counters, invalid}, AnyAnswers{out});
}

template std::size_t first_hits(const Scene<float>&, const Ways<float>&, std::size_t, std::size_t,
                                const HitsOut<float>&, const QueryOptions&, QueryCounters&, std::size_t&);
template std::size_t first_hits(const Scene<double>&, const Ways<double>&, std::size_t, std::size_t,
                                const HitsOut<double>&, const QueryOptions&, QueryCounters&, std::size_t&);
template std::size_t any_hits(const Scene<float>&, const Ways<float>&, std::size_t, std::size_t, std::uint8_t*,
                              const QueryOptions&, QueryCounters&, std::size_t&);
template std::size_t any_hits(const Scene<double>&, const Ways<double>&, std::size_t, std::size_t, std::uint8_t*,
                              const QueryOptions&, QueryCounters&, std::size_t&);

}  // namespace pierce::detail

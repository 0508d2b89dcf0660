// Sums over all that paths may touch, many of them in flight: as flights.cpp does it for hits.
#pragma once

#include <query/counting.h>

namespace pierce::detail {

/// A question under way: number `i` of its batch, and the crossings so far.
struct CountedQuery {
    Path path;
    std::size_t i;
    int sum;
};

/// `Questions` has what is asked:
///   bool next(CountedQuery& query)          begins the next one; false: there is none
///   void finish(const CountedQuery& query)   writes the answer
template <class Scalar, class Questions>
class CountingFlight {
  public:
    CountingFlight(const Scene<Scalar>& scene, Questions& questions, QueryCounters& counters)
        : scene_(scene), questions_(questions), counters_(counters) {}

    void run() {
        const Flight<Scalar> flight{
            this,
            [](void* self, unsigned slot, Probe<Scalar>& probe, float& limit) {
                return static_cast<CountingFlight*>(self)->start(slot, probe, limit);
            },
            [](void* self, unsigned slot, std::uint32_t cluster, unsigned lanes) {
                return static_cast<CountingFlight*>(self)->visit(slot, cluster, lanes);
            },
            [](void* self, unsigned slot) { static_cast<CountingFlight*>(self)->finish(slot); }};
        scene_.backend->template of<Scalar>().fly(scene_.tree.view(), scene_.clusters.records.data(), flight);
    }

  private:
    struct Slot {
        CountedQuery query;
        const Probe<Scalar>* probe;
        float limit;
    };

    bool start(unsigned at, Probe<Scalar>& probe, float& limit) {
        Slot& slot = slots_[at];
        while (questions_.next(slot.query)) {
            if (make_probe(scene_, slot.query.path, Sides::both, 1.0, probe, limit)) {
                slot.probe = &probe;
                slot.limit = limit;
                return true;
            }
            questions_.finish(slot.query);
        }
        return false;
    }
    float visit(unsigned at, std::uint32_t cluster, unsigned lanes) {
        Slot& slot = slots_[at];
        return use_cluster(scene_, *slot.probe, cluster, lanes, slot.limit, counters_,
                           [&](ClusterRef which, unsigned bits) {
                               slot.query.sum += crossings_in(scene_, slot.query.path, which, bits, counters_);
                               return 1.0;
                           });
    }
    void finish(unsigned at) {
        Slot& slot = slots_[at];
        counters_.nodes += slot.probe->nodes;
        counters_.clusters += slot.probe->clusters;
        questions_.finish(slot.query);
    }

    const Scene<Scalar>& scene_;
    Questions& questions_;
    QueryCounters& counters_;
    std::array<Slot, k_flights> slots_;
};

/// One after the other where there is no tree, or one too deep for queries in flight.
template <class Scalar, class Questions>
void fly_and_count(const Scene<Scalar>& scene, Questions& questions, QueryCounters& counters) {
    if (takes_flights(scene)) return CountingFlight<Scalar, Questions>(scene, questions, counters).run();
    CountedQuery query;
    while (questions.next(query)) {
        each_candidate(scene, query.path, Sides::both, 1, counters, [&](ClusterRef cluster, unsigned lanes) {
            query.sum += crossings_in(scene, query.path, cluster, lanes, counters);
            return 1.0;
        });
        questions.finish(query);
    }
}

}  // namespace pierce::detail

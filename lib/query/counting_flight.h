// Sums over all that paths may touch, many of them in flight: as flights.cpp does it for hits.
#pragma once

#include <query/counting.h>

namespace pierce::detail {

/// `Ways` has what is asked:
///   Query                                a question's state in flight, with its `path`
///   bool next(Query& query)              the next one; false: there is none
///   void visit(query, cluster, lanes)    triangles that may be met
///   void finish(query)                   writes the answer
template <class Scalar, class Ways>
class CountingFlight {
  public:
    CountingFlight(const Scene<Scalar>& scene, Ways& ways, QueryCounters& counters)
        : scene_(scene), ways_(ways), counters_(counters) {}

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
        typename Ways::Query query;
        const Probe<Scalar>* probe;
        float limit;
    };

    bool start(unsigned at, Probe<Scalar>& probe, float& limit) {
        Slot& slot = slots_[at];
        while (ways_.next(slot.query)) {
            if (make_probe(scene_, slot.query.path, Sides::both, 1.0, probe, limit)) {
                slot.probe = &probe;
                slot.limit = limit;
                return true;
            }
            ways_.finish(slot.query);
        }
        return false;
    }
    float visit(unsigned at, std::uint32_t cluster, unsigned lanes) {
        Slot& slot = slots_[at];
        return use_cluster(scene_, *slot.probe, cluster, lanes, slot.limit, counters_,
                           [&](ClusterRef which, unsigned bits) {
                               ways_.visit(slot.query, which, bits);
                               return 1.0;
                           });
    }
    void finish(unsigned at) {
        Slot& slot = slots_[at];
        counters_.nodes += slot.probe->nodes;
        counters_.clusters += slot.probe->clusters;
        ways_.finish(slot.query);
    }

    const Scene<Scalar>& scene_;
    Ways& ways_;
    QueryCounters& counters_;
    std::array<Slot, k_flights> slots_;
};

/// One after the other where there is no tree, or one too deep for queries in flight.
template <class Scalar, class Ways>
void fly_and_count(const Scene<Scalar>& scene, Ways& ways, QueryCounters& counters) {
    if (!scene.empty() && scene.broadphase == Broadphase::tree && scene.tree.depth <= k_flight_depth)
        return CountingFlight<Scalar, Ways>(scene, ways, counters).run();
    typename Ways::Query query;
    while (ways.next(query)) {
        each_candidate(scene, query.path, Sides::both, 1, counters, [&](ClusterRef cluster, unsigned lanes) {
            ways.visit(query, cluster, lanes);
            return 1.0;
        });
        ways.finish(query);
    }
}

}  // namespace pierce::detail

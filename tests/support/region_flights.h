// A transport loop: particles that fly through regions, collide, are reflected and go through faces. One is lost where
// the first face that it comes to does not have the particle's region on its side, and where it flies on for ever in a
// region that has an end.
#pragma once

#include <cstdint>
#include <thread>
#include <vector>

#include <Eigen/Geometry>

#include <pierce/pierce.h>
#include <support/region_models.h>

namespace pierce::test {

struct FlightTally {
    std::uint64_t flights = 0;
    std::uint64_t lost = 0;
    std::uint64_t wrong = 0;  ///< places whose region is another than was said, of those that were asked
    std::uint64_t crossings = 0;
    std::uint64_t stops = 0;
    std::uint64_t thin = 0;   ///< crossings that did not come to the next region
    std::uint64_t still = 0;  ///< flights that end where they began

    void add(const FlightTally& more) {
        flights += more.flights;
        lost += more.lost;
        wrong += more.wrong;
        crossings += more.crossings;
        stops += more.stops;
        thin += more.thin;
        still += more.still;
    }
};

/// Where flights go: anywhere, but that of those that are `aimed` a third goes at a vertex, as exactly as a direction
/// can, a third at the middle of an edge, a third along axes and diagonals. About a quarter of the flights ends in a
/// collision.
template <class Scalar>
class FlightPlan {
  public:
    FlightPlan(const RegionModel<Scalar>& model, double aimed, std::uint64_t seed)
        : model_(model), aimed_(aimed), random_(seed) {
        Eigen::AlignedBox<double, 3> box;
        for (const Vec3<Scalar>& p : model.soup.positions) box.extend(p.template cast<double>());
        centre_ = box.center();
        size_ = box.sizes().maxCoeff() / 2;
    }

    Vec3<Scalar> start() { return (centre_ + size_ * random_.in_cube()).template cast<Scalar>(); }
    Ray<Scalar> flight(const Vec3<Scalar>& at, bool outside) {
        Ray<Scalar> ray{at, random_.direction().template cast<Scalar>()};
        const double kind = random_.unit() / aimed_;
        const IndexTriple& t = model_.soup.triangles[random_.below(model_.soup.triangles.size())];
        const auto& p = model_.soup.positions;
        if (outside) {  // back to the model
            const Vec3<Scalar> w = random_.weights().template cast<Scalar>();
            ray.direction = w[0] * p[t[0]] + w[1] * p[t[1]] + w[2] * p[t[2]] - at;
        }
        if (kind * 3 < 1) ray.direction = p[t[0]] - at;
        if (kind * 3 >= 1 && kind * 3 < 2) ray.direction = (p[t[0]] + p[t[1]]) / 2 - at;
        if (kind * 3 >= 2 && kind * 3 < 3)
            for (int k = 0; k < 3; ++k) ray.direction[k] = static_cast<Scalar>(random_.between_ints(-1, 1));
        if (ray.direction == Vec3<Scalar>(0, 0, 0)) ray.direction = Vec3<Scalar>(0, 0, 1);
        if (!outside && random_.chance(0.4))
            ray.limit = static_cast<Scalar>(-size_ / 4 * std::log(1 - random_.unit())) / ray.direction.norm();
        return ray;
    }
    bool reflects() { return random_.chance(0.15); }

  private:
    const RegionModel<Scalar>& model_;
    double aimed_;
    Vec3<double> centre_;
    double size_ = 0;
    Random random_;
};

template <class Scalar>
FlightTally fly(const Regions<Scalar>& regions, FlightPlan<Scalar> plan, std::uint64_t flights) {
    FlightTally tally;
    Vec3<Scalar> at = plan.start();
    std::uint32_t region = regions.region_at(at);
    for (; tally.flights < flights; ++tally.flights) {
        const Ray<Scalar> flight = plan.flight(at, region == regions.outside());
        Leg<Scalar> leg;
        regions.walk(flight, {&leg, 1});
        const bool at_face = leg.face != no_face;
        const bool endless = !at_face && std::isinf(flight.limit);
        if (at_face ? leg.region != region : endless && region != regions.outside()) ++tally.lost;
        if ((at_face && leg.region != region) || endless) {
            at = plan.start();
            region = regions.region_at(at);
            continue;
        }
        const bool crosses = at_face && !plan.reflects();
        leg.region = region;
        const RegionPlace<Scalar> place = crosses ? regions.cross(flight, leg) : regions.stop(flight, leg);
        ++(crosses ? tally.crossings : tally.stops);
        tally.thin += place.reached ? 0U : 1U;
        tally.still += place.point == at ? 1U : 0U;
        at = place.point;
        region = place.region;
        if (tally.flights % 16 == 0 && regions.region_at(at) != region) ++tally.wrong;
    }
    return tally;
}

/// The same by several threads, three of ten flights aimed.
template <class Scalar>
FlightTally fly(const RegionModel<Scalar>& model, const Regions<Scalar>& regions, std::uint64_t flights,
                std::uint64_t seed, unsigned threads) {
    std::vector<FlightTally> tallies(threads);
    std::vector<std::thread> running;
    for (unsigned i = 0; i < threads; ++i)
        running.emplace_back(
            [&, i] { tallies[i] = fly(regions, FlightPlan<Scalar>(model, 0.3, seed + i), flights / threads); });
    FlightTally sum;
    for (unsigned i = 0; i < threads; ++i) {
        running[i].join();
        sum.add(tallies[i]);
    }
    return sum;
}

}  // namespace pierce::test

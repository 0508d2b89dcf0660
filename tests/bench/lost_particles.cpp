// Are particles lost that are transported through regions? By pierce's walks, and by Embree as it is used for this: the
// particle is put at the hit, a little further along, and goes on in the region behind the face.
#include <cmath>

#include <support/region_flights.h>

#include "embree_scene.h"
#include "experiments.h"
#include "table.h"

namespace pierce::bench {
namespace {

constexpr double k_aimed[] = {0, 0.3};

test::RegionModel<double> model() { return test::nested_model(12, 3); }

/// The loop of test::fly with Embree. `offset`: how far beyond the face a particle is put, or before it if it is
/// reflected.
class EmbreeFlights {
  public:
    EmbreeFlights(RTCSceneFlags flags, double offset)
        : device_(""),
          model_(model().as<float>(1, Point(0, 0, 0))),
          scene_(device_, model_.soup.view(), {.flags = flags}),
          mesh_(model_.soup.view()),
          regions_(mesh_, model_.labels),
          offset_(static_cast<float>(offset)) {}

    std::size_t lost(double aimed, std::size_t flights) {
        test::FlightPlan<float> plan(model_, aimed, 1);
        std::size_t lost = 0;
        Vec3<float> at = plan.start();
        std::uint32_t region = regions_.region_at(at);
        const auto begin_again = [&] {
            at = plan.start();
            region = regions_.region_at(at);
        };
        for (std::size_t i = 0; i < flights; ++i) {
            const Ray<float> flight = plan.flight(at, region == regions_.outside());
            RTCRayHit ray;
            set_ray(ray, at, flight.direction);
            ray.ray.tfar = flight.limit;
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            rtcIntersect1(scene_.get(), &context, &ray);
            if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
                if (std::isinf(flight.limit)) {
                    lost += region != regions_.outside() ? 1U : 0U;
                    begin_again();
                } else {
                    at += flight.limit * flight.direction;
                }
                continue;
            }
            const Vec3<float> normal(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z);
            const bool front = normal.dot(flight.direction) < 0;
            const FaceRegions& label = model_.labels[ray.hit.primID];
            if ((front ? label.front : label.behind) != region) {
                ++lost;
                begin_again();
                continue;
            }
            const bool crosses = !plan.reflects();
            const Vec3<float> off = offset_ / flight.direction.norm() * flight.direction;
            at += ray.ray.tfar * flight.direction + (crosses ? off : Vec3<float>(-off));
            if (crosses) region = front ? label.behind : label.front;
        }
        return lost;
    }

  private:
    EmbreeDevice device_;
    test::RegionModel<float> model_;
    EmbreeScene scene_;
    CollisionMesh<float> mesh_;
    Regions<float> regions_;
    float offset_;
};

std::string per_million(std::size_t lost, std::size_t flights) {
    if (lost == 0) return "0";
    std::ostringstream out;
    out << std::fixed << std::setprecision(0) << 1e6 * static_cast<double>(lost) / static_cast<double>(flights);
    return out.str();
}

template <class Scalar>
std::vector<std::string> row_of_pierce(Run& run, const std::string& name, std::size_t flights) {
    const auto scaled = model().as<Scalar>(1, Point(0, 0, 0));
    const CollisionMesh<Scalar> mesh(scaled.soup.view());
    const Regions<Scalar> regions(mesh, scaled.labels);
    std::vector<std::string> row = {name};
    for (const double aimed : k_aimed) {
        const test::FlightTally tally = test::fly(regions, test::FlightPlan<Scalar>(scaled, aimed, 1), flights);
        row.push_back(per_million(tally.lost, flights));
        const Library library{.name = name, .make = nullptr, .is_pierce = true};
        run.must(tally.lost == 0 && tally.wrong == 0, library, "particles were lost", {}, {});
    }
    return row;
}

}  // namespace

void lost_particles(Run& run) {
    const std::size_t flights = run.many(1'000'000);
    Table table({"lost, of a million flights", "anywhere", "3 of 10 aimed"});
    table.add(row_of_pierce<float>(run, "**pierce**, float", flights));
    table.add(row_of_pierce<double>(run, "**pierce**, double", flights));
    for (const double offset : {0.0, 1e-6, 1e-5, 1e-4, 1e-3})
        for (const bool robust : {false, true}) {
            std::ostringstream name;
            name << (robust ? "Embree, robust" : "Embree") << ", offset " << offset;
            EmbreeFlights embree(robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE, offset);
            std::vector<std::string> row = {name.str()};
            for (const double aimed : k_aimed) row.push_back(per_million(embree.lost(aimed, flights), flights));
            table.add(row);
        }
    std::cout
        << "### 6. Lost particles\n\n"
        << flights
        << " flights of particles through 34 regions: bumpy shells around one another, of radius 1 to 2.5, divided by "
           "walls, with cubes in the middle that meet in faces, edges and vertices; "
        << model().soup.triangles.size()
        << " faces, each with a region on either side. A flight ends in a collision, is reflected, or goes through a "
           "face into the region behind it. A particle is lost where the next face does not have its region on this "
           "side, or there is no face at all. pierce puts particles where `stop` and `cross` say. With Embree they "
           "are put at the hit and an offset further along the flight, as its users do. Aimed are flights at "
           "vertices, middles of edges, and along axes and diagonals.\n\n";
    table.print(std::cout);
}

}  // namespace pierce::bench

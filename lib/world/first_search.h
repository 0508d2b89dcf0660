// The first hit of a way in a world, of those in its meshes that are offered one after the other. It does not depend on
// their order.
#pragma once

#include <array>
#include <optional>

#include <world/collectors.h>
#include <world/order.h>

namespace pierce::detail {

/// The options of a query as one mesh understands them; `options` must live as long.
[[nodiscard]] inline QueryOptions options_in(const WorldOptions& options, MeshId mesh) {
    QueryOptions here;
    here.sides = options.sides;
    if (options.accept)
        here.accept = [accept = &options.accept, mesh](const Contact& contact) { return (*accept)(mesh, contact); };
    return here;
}

/// What is looked for in one mesh.
template <class Scalar, class Passed>
struct Searched {
    Searched(const WorldScene<Scalar>& world, std::uint32_t at, const Path& image, const WorldOptions& asked,
             double limit, const Passed& passed, QueryCounters& counters)
        : index(at),
          local(image),
          collector(world.instances[at], asked.mask, local, limit, passed, counters),
          options(options_in(asked, world.id_of(at))) {}
    Searched(const Searched&) = delete;
    Searched& operator=(const Searched&) = delete;

    [[nodiscard]] Found found() const { return {index, collector.best()}; }

    std::uint32_t index;
    Path local;
    FirstHere<Scalar, Passed> collector;
    QueryOptions options;
};

/// For each mesh: `next`, then the collector is given what the way hits, then `take`.
template <class Scalar, class Passed>
class FirstSearch {
  public:
    template <class... Given>
    Searched<Scalar, Passed>& next(Given&&... given) {
        return rooms_[1 - best_].emplace(std::forward<Given>(given)...);
    }
    /// Returns the fraction from which on hits are of no use.
    double take(const WorldScene<Scalar>& world, const Path& path, double limit, QueryCounters& counters) {
        const Searched<Scalar, Passed>& here = *rooms_[1 - best_];
        if (!here.collector.found()) return limit;
        if (found_ && !comes_before(world, path, here.found(), first().found(), counters)) return limit;
        found_ = true;
        best_ = 1 - best_;
        return std::min(limit, here.collector.best().latest);
    }
    [[nodiscard]] bool found() const { return found_; }
    [[nodiscard]] const Searched<Scalar, Passed>& first() const { return *rooms_[best_]; }

  private:
    std::array<std::optional<Searched<Scalar, Passed>>, 2> rooms_;
    std::size_t best_ = 0;
    bool found_ = false;
};

}  // namespace pierce::detail

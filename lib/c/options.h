// Options of C as those of C++. What has no meaning is said by `false`: single queries have no status.
#pragma once

#include <c/given.h>

namespace pierce::detail {

inline Accept accept_of(pierce_accept accept, void* user) {
    if (accept == nullptr) return {};
    return [accept, user](const Contact& contact) -> bool {
        const Vec3<double>& weights = contact.barycentric;
        const pierce_contact seen{contact.face,
                                  contact.triangle,
                                  static_cast<std::uint8_t>(contact.side),
                                  static_cast<std::uint8_t>(contact.feature),
                                  contact.feature_index,
                                  contact.at_start,
                                  contact.fraction,
                                  {weights[0], weights[1], weights[2]}};
        return accept(&seen, user);
    };
}

inline QueryCounters* counters_of(pierce_counters* counters) { return same_bytes<QueryCounters>(counters); }

/// What both kinds of options have.
template <class Given, class Options>
bool read_filters(const Given& given, Options& options) {
    if (given.face_mask == nullptr && given.face_mask_count != 0) return false;
    if (given.max_fraction != nullptr) options.max_fraction = *given.max_fraction;
    options.face_mask = {given.face_mask, given.face_mask_count};
    options.accept = accept_of(given.accept, given.accept_user);
    options.counters = counters_of(given.counters);
    return true;
}

[[nodiscard]] inline bool read_options(const pierce_query_options* given, QueryOptions& options) {
    if (given == nullptr) return true;
    const int sides = number_of(given->sides);
    if (sides < PIERCE_FRONT || sides > PIERCE_BOTH) return false;
    options.sides = static_cast<Sides>(sides);
    return read_filters(*given, options);
}

[[nodiscard]] inline bool read_options(const pierce_passage_options* given, PassageOptions& options) {
    if (given == nullptr) return true;
    const int side = number_of(given->side);
    if (given->one_sided && side != PIERCE_FRONT && side != PIERCE_BACK) return false;
    if (given->one_sided) options.sides = static_cast<Sides>(side);
    options.count_all = !given->stop_when_full;
    return read_filters(*given, options);
}

inline QueryOptions options_of(const Caller& caller, const pierce_query_options* given) {
    QueryOptions options;
    if (!read_options(given, options)) caller.refuse("sides is none of the three, or face_mask is null");
    return options;
}

inline BuildOptions options_of(const Caller& caller, const pierce_build_options* given) {
    BuildOptions options;
    if (given == nullptr) return options;
    const int broadphase = number_of(given->broadphase);
    if (broadphase < PIERCE_AUTOMATIC || broadphase > PIERCE_GRID)
        caller.refuse("there is no broadphase " + std::to_string(broadphase));
    options.broadphase = static_cast<Broadphase>(broadphase);
    options.cell_size = given->cell_size;
    options.max_grid_bytes = given->max_grid_bytes;
    if (given->backend != nullptr) options.backend = given->backend;
    options.executor = executor_of(given->executor);
    return options;
}

}  // namespace pierce::detail

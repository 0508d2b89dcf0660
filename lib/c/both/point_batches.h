// Batches of points in C, for one scalar. Included twice by pierce_c.cpp.

pierce_status C(contains_points)(const C(mesh)* mesh, const C(points)* points, uint8_t* answers, size_t* count,
                                 pierce_counters* counters, const pierce_executor* executor) {
    return guarded(__func__, [&](const Caller& caller) {
        const auto& asked = caller.given(mesh, "mesh").mesh;
        const auto all = points_of(caller, caller.given(points, "points"), "points.first");
        const auto out = caller.array(answers, all.size(), "answers");
        give(asked.contains_points(all, out, counters_of(counters), executor_of(executor)), count);
    });
}

pierce_status C(winding_numbers)(const C(mesh)* mesh, const C(points)* points, int* numbers,
                                 pierce_counters* counters, const pierce_executor* executor) {
    return guarded(__func__, [&](const Caller& caller) {
        const auto& asked = caller.given(mesh, "mesh").mesh;
        const auto all = points_of(caller, caller.given(points, "points"), "points.first");
        const auto out = caller.array(numbers, all.size(), "numbers");
        asked.winding_numbers(all, out, counters_of(counters), executor_of(executor));
    });
}

pierce_status C(locate_points)(const C(mesh)* mesh, const C(points)* points, pierce_location* locations,
                               size_t* count, pierce_counters* counters, const pierce_executor* executor) {
    return guarded(__func__, [&](const Caller& caller) {
        const auto& asked = caller.given(mesh, "mesh").mesh;
        const auto all = points_of(caller, caller.given(points, "points"), "points.first");
        const auto out = caller.array(same_bytes<Location>(locations), all.size(), "locations");
        give(asked.locate_points(all, out, counters_of(counters), executor_of(executor)), count);
    });
}

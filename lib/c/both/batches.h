// Batches of segments and rays in C, for one scalar. Included twice by pierce_c.cpp.

pierce_status C(first_hits)(const C(mesh)* mesh, const C(segments)* segments, C(hit)* hits, size_t* count,
                            const pierce_query_options* options, const pierce_executor* executor) {
    return guarded(__func__, [&](const Caller& caller) {
        const auto& asked = caller.given(mesh, "mesh").mesh;
        const auto all = segments_of<SCALAR>(caller, segments);
        const auto out = caller.array(same_bytes<Hit<SCALAR>>(hits), all.size(), "hits");
        give(asked.first_hits(all, out, options_of(caller, options), executor_of(executor)), count);
    });
}

pierce_status C(sweeps)(const C(mesh)* mesh, const C(segments)* steps, C(hit)* hits, size_t* count,
                        const pierce_query_options* options, const pierce_executor* executor) {
    return guarded(__func__, [&](const Caller& caller) {
        const auto& asked = caller.given(mesh, "mesh").mesh;
        const auto all = segments_of<SCALAR>(caller, steps);
        const auto out = caller.array(same_bytes<Hit<SCALAR>>(hits), all.size(), "hits");
        give(asked.sweeps(all, out, options_of(caller, options), executor_of(executor)), count);
    });
}

pierce_status C(first_hits_of_rays)(const C(mesh)* mesh, const C(rays)* rays, C(hit)* hits, size_t* count,
                                    const pierce_query_options* options, const pierce_executor* executor) {
    return guarded(__func__, [&](const Caller& caller) {
        const auto& asked = caller.given(mesh, "mesh").mesh;
        const auto all = rays_of<SCALAR>(caller, rays);
        const auto out = caller.array(same_bytes<Hit<SCALAR>>(hits), all.size(), "hits");
        give(asked.first_hits(all, out, options_of(caller, options), executor_of(executor)), count);
    });
}

pierce_status C(first_hit_arrays)(const C(mesh)* mesh, const C(segments)* segments, const C(hit_arrays)* arrays,
                                  size_t* count, const pierce_query_options* options,
                                  const pierce_executor* executor) {
    return guarded(__func__, [&](const Caller& caller) {
        const auto& asked = caller.given(mesh, "mesh").mesh;
        const auto all = segments_of<SCALAR>(caller, segments);
        const auto out = arrays_of<SCALAR>(caller.given(arrays, "arrays"), all.size());
        give(asked.first_hits(all, out, options_of(caller, options), executor_of(executor)), count);
    });
}

pierce_status C(first_hit_arrays_of_rays)(const C(mesh)* mesh, const C(rays)* rays, const C(hit_arrays)* arrays,
                                          size_t* count, const pierce_query_options* options,
                                          const pierce_executor* executor) {
    return guarded(__func__, [&](const Caller& caller) {
        const auto& asked = caller.given(mesh, "mesh").mesh;
        const auto all = rays_of<SCALAR>(caller, rays);
        const auto out = arrays_of<SCALAR>(caller.given(arrays, "arrays"), all.size());
        give(asked.first_hits(all, out, options_of(caller, options), executor_of(executor)), count);
    });
}

pierce_status C(any_hits)(const C(mesh)* mesh, const C(segments)* segments, uint8_t* answers, size_t* count,
                          const pierce_query_options* options, const pierce_executor* executor) {
    return guarded(__func__, [&](const Caller& caller) {
        const auto& asked = caller.given(mesh, "mesh").mesh;
        const auto all = segments_of<SCALAR>(caller, segments);
        const auto out = caller.array(answers, all.size(), "answers");
        give(asked.any_hits(all, out, options_of(caller, options), executor_of(executor)), count);
    });
}

pierce_status C(any_hits_of_rays)(const C(mesh)* mesh, const C(rays)* rays, uint8_t* answers, size_t* count,
                                  const pierce_query_options* options, const pierce_executor* executor) {
    return guarded(__func__, [&](const Caller& caller) {
        const auto& asked = caller.given(mesh, "mesh").mesh;
        const auto all = rays_of<SCALAR>(caller, rays);
        const auto out = caller.array(answers, all.size(), "answers");
        give(asked.any_hits(all, out, options_of(caller, options), executor_of(executor)), count);
    });
}

pierce_status C(all_hit_rows)(const C(mesh)* mesh, const C(segments)* segments, size_t* offsets, C(hit)* hits,
                              size_t capacity, size_t* count, const pierce_query_options* options,
                              const pierce_executor* executor) {
    return guarded(__func__, [&](const Caller& caller) {
        const auto& asked = caller.given(mesh, "mesh").mesh;
        const auto all = segments_of<SCALAR>(caller, segments);
        const auto rows = caller.array(offsets, all.size() + 1, "offsets");
        const auto out = caller.array(same_bytes<Hit<SCALAR>>(hits), capacity, "hits");
        give(asked.all_hits(all, rows, out, options_of(caller, options), executor_of(executor)), count);
    });
}

pierce_status C(all_hit_rows_of_rays)(const C(mesh)* mesh, const C(rays)* rays, size_t* offsets, C(hit)* hits,
                                      size_t capacity, size_t* count, const pierce_query_options* options,
                                      const pierce_executor* executor) {
    return guarded(__func__, [&](const Caller& caller) {
        const auto& asked = caller.given(mesh, "mesh").mesh;
        const auto all = rays_of<SCALAR>(caller, rays);
        const auto rows = caller.array(offsets, all.size() + 1, "offsets");
        const auto out = caller.array(same_bytes<Hit<SCALAR>>(hits), capacity, "hits");
        give(asked.all_hits(all, rows, out, options_of(caller, options), executor_of(executor)), count);
    });
}

pierce_status C(crossing_counts)(const C(mesh)* mesh, const C(segments)* segments, int* crossings,
                                 pierce_counters* counters, const pierce_executor* executor) {
    return guarded(__func__, [&](const Caller& caller) {
        const auto& asked = caller.given(mesh, "mesh").mesh;
        const auto all = segments_of<SCALAR>(caller, segments);
        const auto out = caller.array(crossings, all.size(), "crossings");
        asked.crossings(all, out, counters_of(counters), executor_of(executor));
    });
}

pierce_status C(crossing_counts_of_rays)(const C(mesh)* mesh, const C(rays)* rays, int* crossings,
                                         pierce_counters* counters, const pierce_executor* executor) {
    return guarded(__func__, [&](const Caller& caller) {
        const auto& asked = caller.given(mesh, "mesh").mesh;
        const auto all = rays_of<SCALAR>(caller, rays);
        const auto out = caller.array(crossings, all.size(), "crossings");
        asked.crossings(all, out, counters_of(counters), executor_of(executor));
    });
}

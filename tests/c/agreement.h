// Every function of the C interface says what the C++ one says, for one scalar. Included twice by agreement_test.cpp.

TEST(SUITE, SingleQueries) {
    const Cubes<SCALAR> cubes;
    const Handle<C(mesh), C(mesh_destroy)> mesh(make(C(mesh_create), C(points){}));
    std::vector<Hit<SCALAR>> hits(8);
    std::vector<C(hit)> c_hits(8);
    std::vector<Passage<SCALAR>> passages(8);
    std::vector<C(passage)> c_passages(8);
    std::vector<FaceTouch> faces(48);
    std::vector<pierce_face_touch> c_faces(48);
    std::size_t found = 0;
    for (const auto& [from, to] : random_segments<SCALAR>(k_segments)) {
        const Segment<SCALAR> segment{from, to};
        const SCALAR limit = 2;
        const Ray<SCALAR> ray{from, to, limit};
        const SCALAR *a = from.data(), *b = to.data();
        for (const Sides sides : {Sides::front, Sides::back, Sides::both}) {
            const double bound = 0.75;
            const QueryOptions options{.sides = sides, .max_fraction = bound};
            pierce_query_options c_options{};
            c_options.sides = static_cast<pierce_sides>(sides);
            c_options.max_fraction = &bound;
            C(hit) hit;
            const auto first = cubes.mesh.first_hit(segment, options);
            ASSERT_EQ(first.has_value(), C(first_hit)(mesh, a, b, &hit, &c_options));
            ASSERT_TRUE(same_memory(first.value_or(no_hit<SCALAR>), hit));
            found += first.has_value();
            ASSERT_EQ(first.has_value(), C(sweep)(mesh, a, b, &hit, &c_options));
            ASSERT_TRUE(same_memory(first.value_or(no_hit<SCALAR>), hit));
            ASSERT_EQ(first.has_value(), C(any_hit)(mesh, a, b, &c_options));
            const auto of_ray = cubes.mesh.first_hit(ray, options);
            ASSERT_EQ(of_ray.has_value(), C(first_hit_of_ray)(mesh, a, b, limit, &hit, &c_options));
            ASSERT_TRUE(same_memory(of_ray.value_or(no_hit<SCALAR>), hit));
            ASSERT_EQ(of_ray.has_value(), C(any_hit_of_ray)(mesh, a, b, limit, &c_options));

            std::size_t count = cubes.mesh.all_hits(segment, hits, options);
            ASSERT_EQ(count, C(all_hits)(mesh, a, b, c_hits.data(), c_hits.size(), &c_options));
            for (std::size_t i = 0; i < std::min(count, hits.size()); ++i) ASSERT_TRUE(same_memory(hits[i], c_hits[i]));
            count = cubes.mesh.all_hits(ray, hits, options);
            ASSERT_EQ(count, C(all_hits_of_ray)(mesh, a, b, limit, c_hits.data(), c_hits.size(), &c_options));
            for (std::size_t i = 0; i < std::min(count, hits.size()); ++i) ASSERT_TRUE(same_memory(hits[i], c_hits[i]));
        }
        ASSERT_EQ(cubes.mesh.crossings(segment), C(crossings)(mesh, a, b, nullptr));
        ASSERT_EQ(cubes.mesh.crossings(ray), C(crossings_of_ray)(mesh, a, b, limit, nullptr));
        ASSERT_EQ(cubes.mesh.winding_number(from), C(winding_number)(mesh, a, nullptr));
        ASSERT_EQ(cubes.mesh.contains(from), C(contains)(mesh, a, nullptr));

        const Location where = cubes.mesh.locate(from, faces);
        const pierce_location c_where = C(locate)(mesh, a, c_faces.data(), c_faces.size(), nullptr);
        ASSERT_EQ(static_cast<int>(where.place), c_where.place);
        ASSERT_EQ(where.winding_number, c_where.winding_number);
        ASSERT_EQ(where.face_count, c_where.face_count);
        for (std::size_t i = 0; i < where.face_count; ++i) ASSERT_EQ(faces[i].face, c_faces[i].face);

        const std::size_t count = cubes.mesh.passages(segment, passages, {}, faces);
        ASSERT_EQ(count, C(passages)(mesh, a, b, c_passages.data(), c_passages.size(), c_faces.data(), c_faces.size(),
                                     nullptr));
        for (std::size_t i = 0; i < count; ++i) {
            const Passage<SCALAR>& one = passages[i];
            const C(passage)& other = c_passages[i];
            ASSERT_EQ(one.fraction, other.fraction);
            ASSERT_TRUE(same_memory(one.position, other.position));
            ASSERT_EQ(one.face, other.face);
            ASSERT_EQ(one.crossings, other.crossings);
            ASSERT_EQ(static_cast<int>(one.kind), other.kind);
            ASSERT_EQ(one.at_end, other.at_end);
            for (std::size_t k = one.first_face; k < one.first_face + one.face_count; ++k)
                ASSERT_EQ(faces[k].crossing, c_faces[k].crossing);
        }
    }
    EXPECT_GT(found, k_segments);
}

TEST(SUITE, Batches) {
    const Cubes<SCALAR> cubes;
    const Handle<C(mesh), C(mesh_destroy)> mesh(make(C(mesh_create), C(points){}));
    const auto segments = random_segments<SCALAR>(k_segments);
    const auto stride = static_cast<std::ptrdiff_t>(sizeof(Segment<SCALAR>));
    C(points) from{}, to{};
    from.first = segments[0].from.data();
    to.first = segments[0].to.data();
    from.count = to.count = segments.size();
    from.stride = to.stride = stride;
    const C(segments) all{from, to};
    const SCALAR limit = 2;
    C(rays) rays{};
    rays.origins = from;
    rays.directions = to;
    rays.limits = &limit;
    rays.limit_count = 1;
    const Rays<SCALAR> same_rays({from.first, from.count, stride}, {to.first, to.count, stride}, limit);

    std::vector<Hit<SCALAR>> hits(segments.size());
    std::vector<C(hit)> c_hits(segments.size());
    std::vector<std::uint8_t> bytes(segments.size()), c_bytes(segments.size());
    std::vector<std::uint32_t> faces(segments.size());
    std::vector<int> numbers(segments.size()), c_numbers(segments.size());
    std::vector<std::size_t> offsets(segments.size() + 1), c_offsets(segments.size() + 1);
    C(hit_arrays) arrays{};
    arrays.face = faces.data();
    const auto faces_of_hits = [&] {
        for (std::size_t i = 0; i < hits.size(); ++i)
            if (faces[i] != hits[i].face) return false;
        return true;
    };

    std::size_t count = 0;
    EXPECT_EQ(PIERCE_OK, C(first_hits)(mesh, &all, c_hits.data(), &count, nullptr, nullptr));
    EXPECT_EQ(cubes.mesh.first_hits(segments, std::span(hits)), count);
    EXPECT_TRUE(same_arrays(hits, c_hits));
    EXPECT_EQ(PIERCE_OK, C(sweeps)(mesh, &all, c_hits.data(), nullptr, nullptr, nullptr));
    EXPECT_TRUE(same_arrays(hits, c_hits));
    EXPECT_EQ(PIERCE_OK, C(first_hit_arrays)(mesh, &all, &arrays, nullptr, nullptr, nullptr));
    EXPECT_TRUE(faces_of_hits());
    EXPECT_EQ(PIERCE_OK, C(first_hits_of_rays)(mesh, &rays, c_hits.data(), &count, nullptr, nullptr));
    EXPECT_EQ(cubes.mesh.first_hits(same_rays, std::span(hits)), count);
    EXPECT_TRUE(same_arrays(hits, c_hits));
    EXPECT_EQ(PIERCE_OK, C(first_hit_arrays_of_rays)(mesh, &rays, &arrays, nullptr, nullptr, nullptr));
    EXPECT_TRUE(faces_of_hits());

    EXPECT_EQ(PIERCE_OK, C(any_hits)(mesh, &all, c_bytes.data(), &count, nullptr, nullptr));
    EXPECT_EQ(cubes.mesh.any_hits(segments, bytes), count);
    EXPECT_EQ(bytes, c_bytes);
    EXPECT_EQ(PIERCE_OK, C(any_hits_of_rays)(mesh, &rays, c_bytes.data(), &count, nullptr, nullptr));
    EXPECT_EQ(cubes.mesh.any_hits(same_rays, bytes), count);
    EXPECT_EQ(bytes, c_bytes);

    hits.resize(4 * segments.size());
    c_hits.resize(hits.size());
    std::size_t total = cubes.mesh.all_hits(segments, offsets, std::span(hits));
    EXPECT_EQ(PIERCE_OK, C(all_hit_rows)(mesh, &all, c_offsets.data(), c_hits.data(), c_hits.size(), &count, nullptr,
                                         nullptr));
    EXPECT_EQ(count, total);
    EXPECT_EQ(offsets, c_offsets);
    hits.resize(total), c_hits.resize(total);
    EXPECT_TRUE(same_arrays(hits, c_hits));
    hits.resize(4 * segments.size()), c_hits.resize(hits.size());
    total = cubes.mesh.all_hits(same_rays, offsets, std::span(hits));
    EXPECT_EQ(PIERCE_OK, C(all_hit_rows_of_rays)(mesh, &rays, c_offsets.data(), c_hits.data(), c_hits.size(), &count,
                                                 nullptr, nullptr));
    EXPECT_EQ(count, total);
    EXPECT_EQ(offsets, c_offsets);
    hits.resize(total), c_hits.resize(total);
    EXPECT_TRUE(same_arrays(hits, c_hits));

    cubes.mesh.crossings(segments, numbers);
    EXPECT_EQ(PIERCE_OK, C(crossing_counts)(mesh, &all, c_numbers.data(), nullptr, nullptr));
    EXPECT_EQ(numbers, c_numbers);
    cubes.mesh.crossings(same_rays, numbers);
    EXPECT_EQ(PIERCE_OK, C(crossing_counts_of_rays)(mesh, &rays, c_numbers.data(), nullptr, nullptr));
    EXPECT_EQ(numbers, c_numbers);

    const PointsView<SCALAR> points(from.first, from.count, stride);
    EXPECT_EQ(PIERCE_OK, C(contains_points)(mesh, &from, c_bytes.data(), &count, nullptr, nullptr));
    EXPECT_EQ(cubes.mesh.contains_points(points, bytes), count);
    EXPECT_EQ(bytes, c_bytes);
    EXPECT_EQ(PIERCE_OK, C(winding_numbers)(mesh, &from, c_numbers.data(), nullptr, nullptr));
    cubes.mesh.winding_numbers(points, numbers);
    EXPECT_EQ(numbers, c_numbers);
    std::vector<Location> places(segments.size());
    std::vector<pierce_location> c_places(segments.size());
    EXPECT_EQ(PIERCE_OK, C(locate_points)(mesh, &from, c_places.data(), &count, nullptr, nullptr));
    EXPECT_EQ(cubes.mesh.locate_points(points, places), count);
    for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_EQ(static_cast<int>(places[i].place), c_places[i].place);
        EXPECT_EQ(places[i].winding_number, c_places[i].winding_number);
        EXPECT_EQ(places[i].face_count, c_places[i].face_count);
    }
}

TEST(SUITE, Regions) {
    const Cubes<SCALAR> cubes;
    const Handle<C(mesh), C(mesh_destroy)> mesh(make(C(mesh_create), C(points){}));
    std::vector<FaceRegions> labels(CUBE_FACES);
    std::vector<pierce_face_regions> c_labels(CUBE_FACES);
    for (std::size_t f = 0; f < CUBE_FACES; ++f) {
        labels[f] = f < 12 ? FaceRegions{7, 1} : FaceRegions{1, 2};
        c_labels[f] = {labels[f].front, labels[f].behind};
    }
    const Regions<SCALAR> regions(cubes.mesh, labels, 7);
    C(regions)* made = nullptr;
    ASSERT_EQ(PIERCE_OK, C(regions_create)(mesh, c_labels.data(), c_labels.size(), 7, &made));
    const Handle<C(regions), C(regions_destroy)> handle(made);
    EXPECT_EQ(7U, C(regions_outside)(handle));
    pierce_label_report report;
    EXPECT_EQ(PIERCE_OK, C(regions_check)(handle, &report, nullptr, 0, nullptr));
    EXPECT_TRUE(report.agree);

    const auto same_legs = [](const Leg<SCALAR>& one, const C(leg)& other) {
        return one.entry == other.entry && one.exit == other.exit && one.region == other.region &&
               one.next == other.next && one.face == other.face && one.consistent == other.consistent;
    };
    const auto same_places = [](const RegionPlace<SCALAR>& one, const C(region_place)& other, bool reached) {
        return one.point == vec(other.point) && one.region == other.region && one.reached == other.reached &&
               reached == other.reached;
    };
    std::vector<Leg<SCALAR>> legs(8);
    std::vector<C(leg)> c_legs(8);
    C(region_place) place;
    for (const auto& [from, to] : random_segments<SCALAR>(k_segments)) {
        const SCALAR *a = from.data(), *b = to.data(), limit = 2;
        const Segment<SCALAR> segment{from, to};
        const Ray<SCALAR> ray{from, to, limit};
        ASSERT_EQ(regions.region_at(from), C(region_at)(handle, a));
        std::size_t count = regions.walk(segment, legs);
        ASSERT_EQ(count, C(walk)(handle, a, b, c_legs.data(), c_legs.size()));
        for (std::size_t i = 0; i < count; ++i) ASSERT_TRUE(same_legs(legs[i], c_legs[i]));
        if (count > 0) {
            bool reached = C(stop)(handle, a, b, &c_legs[0], &place);
            ASSERT_TRUE(same_places(regions.stop(segment, legs[0]), place, reached));
            reached = C(cross)(handle, a, b, &c_legs[0], &place);
            ASSERT_TRUE(same_places(regions.cross(segment, legs[0]), place, reached));
        }
        count = regions.walk(ray, legs);
        ASSERT_EQ(count, C(walk_of_ray)(handle, a, b, limit, c_legs.data(), c_legs.size()));
        for (std::size_t i = 0; i < count; ++i) ASSERT_TRUE(same_legs(legs[i], c_legs[i]));
        if (count > 0) {
            bool reached = C(stop_of_ray)(handle, a, b, limit, &c_legs[0], &place);
            ASSERT_TRUE(same_places(regions.stop(ray, legs[0]), place, reached));
            reached = C(cross_of_ray)(handle, a, b, limit, &c_legs[0], &place);
            ASSERT_TRUE(same_places(regions.cross(ray, legs[0]), place, reached));
        }
    }
}

// What the mesh says to the segments, and how that is written down: a table for people, CSV for programs.
#pragma once

#include <cstddef>
#include <optional>
#include <ostream>
#include <span>
#include <vector>

#include <pierce/collision_mesh.h>

#include "cast/options.h"
#include "cast/progress.h"

/// One hit of a segment, or its one miss.
template <class Scalar>
struct Answer {
    std::size_t segment;
    bool is_hit;
    std::optional<pierce::Hit<Scalar>> hit;  ///< empty for a miss, and if the question was only `any`
};

template <class Scalar>
struct Answers {
    Question question = Question::first;
    std::vector<Answer<Scalar>> rows;
    std::size_t segments_hit = 0;
    std::size_t hits = 0;
    pierce::QueryCounters counters;
};

/// Casts the segments one after the other, in this thread.
template <class Scalar>
Answers<Scalar> ask(const pierce::CollisionMesh<Scalar>& mesh, std::span<const pierce::Segment<Scalar>> segments,
                    const Options& options, Progress& progress);

/// At most `most_rows` of them, and then how many were left out.
template <class Scalar>
void write_table(std::ostream& out, const Answers<Scalar>& answers, std::size_t most_rows);

template <class Scalar>
void write_csv(std::ostream& out, const Answers<Scalar>& answers);

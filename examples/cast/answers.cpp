// See answers.h.
#include "cast/answers.h"

#include <algorithm>
#include <string>

#include "cast/numbers.h"

namespace {

using Row = std::vector<std::string>;

Row column_names(Question question) {
    if (question == Question::any) return {"segment", "hit"};
    return {"segment", "face", "side", "feature", "exact_fraction", "fraction", "x", "y", "z"};
}

template <class Scalar>
std::string feature_name(const pierce::Hit<Scalar>& hit) {
    switch (hit.feature) {
        case pierce::Feature::edge:
            return "edge " + std::to_string(hit.feature_index);
        case pierce::Feature::vertex:
            return "vertex " + std::to_string(hit.feature_index);
        case pierce::Feature::face:
            break;
    }
    return "face";
}

/// A row of text; `number` writes a coordinate or fraction, and `nothing` stands where a miss has no value.
template <class Scalar, class Write>
Row to_row(const Answer<Scalar>& answer, Question question, Write number, const std::string& nothing) {
    Row row = {std::to_string(answer.segment)};
    if (question == Question::any) {
        row.push_back(answer.is_hit ? "yes" : "no");
    } else if (!answer.hit) {
        row.resize(column_names(question).size(), nothing);
    } else {
        const auto& hit = *answer.hit;
        row.insert(row.end(), {std::to_string(hit.face), hit.side == pierce::Sides::front ? "front" : "back",
                               feature_name(hit), number(hit.exact_fraction), number(hit.fraction),
                               number(hit.point.x()), number(hit.point.y()), number(hit.point.z())});
    }
    return row;
}

}  // namespace

template <class Scalar>
Answers<Scalar> ask(const pierce::CollisionMesh<Scalar>& mesh, std::span<const pierce::Segment<Scalar>> segments,
                    const Options& options, Progress& progress) {
    Answers<Scalar> answers;
    answers.question = options.question;
    answers.rows.reserve(segments.size());
    const pierce::QueryOptions query = {
        .sides = options.sides, .max_fraction = options.max_fraction, .counters = &answers.counters};

    std::vector<pierce::Hit<Scalar>> hits(64);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        std::size_t count = 0;
        switch (options.question) {
            case Question::first:
                if (const auto hit = mesh.first_hit(segments[i], query)) {
                    answers.rows.push_back({i, true, hit});
                    count = 1;
                }
                break;
            case Question::any:
                if (mesh.any_hit(segments[i], query)) {
                    answers.rows.push_back({i, true, std::nullopt});
                    count = 1;
                }
                break;
            case Question::all:
                count = mesh.all_hits(segments[i], hits, query);
                if (count > hits.size()) {  // now the number is known: ask again with room for all of them
                    hits.resize(count);
                    mesh.all_hits(segments[i], hits, query);
                }
                for (const auto& hit : std::span(hits).first(count)) answers.rows.push_back({i, true, hit});
                break;
        }
        if (count == 0) answers.rows.push_back({i, false, std::nullopt});
        answers.segments_hit += count > 0;
        answers.hits += count;
        if (constexpr std::size_t block = 1024; i % block == block - 1) progress.add(block);
    }
    return answers;
}

template <class Scalar>
void write_table(std::ostream& out, const Answers<Scalar>& answers, std::size_t most_rows) {
    std::vector<Row> rows = {column_names(answers.question)};
    std::ranges::replace(rows[0], "exact_fraction", "exact fraction");
    const std::size_t shown = std::min(most_rows, answers.rows.size());
    for (const auto& answer : std::span(answers.rows).first(shown))
        rows.push_back(to_row(
            answer, answers.question, [](Scalar number) { return rounded(number); }, "-"));

    std::vector<std::size_t> widths(rows[0].size(), 0);
    for (const Row& row : rows)
        for (std::size_t column = 0; column < row.size(); ++column)
            widths[column] = std::max(widths[column], row[column].size());
    for (const Row& row : rows) {
        std::string line;
        for (std::size_t column = 0; column < row.size(); ++column)
            line += (column > 0 ? "  " : "") + std::string(widths[column] - row[column].size(), ' ') + row[column];
        out << line << '\n';
    }
    if (shown < answers.rows.size())
        out << "... and " << grouped(answers.rows.size() - shown) << " more rows (--all-rows shows them)\n";
}

template <class Scalar>
void write_csv(std::ostream& out, const Answers<Scalar>& answers) {
    const auto write = [&out](const Row& row) {
        for (std::size_t column = 0; column < row.size(); ++column) out << (column > 0 ? "," : "") << row[column];
        out << '\n';
    };
    write(column_names(answers.question));
    for (const auto& answer : answers.rows)
        write(to_row(
            answer, answers.question, [](Scalar number) { return shortest(number); }, ""));
}

template Answers<float> ask(const pierce::CollisionMesh<float>&, std::span<const pierce::Segment<float>>,
                            const Options&, Progress&);
template Answers<double> ask(const pierce::CollisionMesh<double>&, std::span<const pierce::Segment<double>>,
                             const Options&, Progress&);
template void write_table(std::ostream&, const Answers<float>&, std::size_t);
template void write_table(std::ostream&, const Answers<double>&, std::size_t);
template void write_csv(std::ostream&, const Answers<float>&);
template void write_csv(std::ostream&, const Answers<double>&);

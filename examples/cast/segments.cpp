// See segments.h.
#include "cast/segments.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <random>

#include "cast/numbers.h"

namespace {

using pierce::Segment;
using pierce::Vec3;
using Point = pierce::Vec3<double>;

std::vector<std::string_view> split_words(std::string_view text) {
    constexpr auto spaces = " \t\r\v\f";
    std::vector<std::string_view> words;
    for (auto start = text.find_first_not_of(spaces); start != text.npos; start = text.find_first_not_of(spaces)) {
        text.remove_prefix(start);
        words.push_back(text.substr(0, text.find_first_of(spaces)));
        text.remove_prefix(words.back().size());
    }
    return words;
}

template <class Scalar>
Segment<Scalar> parse_segment(std::string_view text) {
    const auto words = split_words(text);
    if (words.size() != 6) throw InputError("expected six numbers, found " + std::to_string(words.size()));
    std::array<Scalar, 6> numbers;
    std::ranges::transform(words, numbers.begin(), parse_number<Scalar>);
    return {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
}

template <class Scalar>
void read_segments(std::istream& in, const std::string& name, std::vector<Segment<Scalar>>& segments) {
    std::size_t line_number = 0;
    for (std::string line; std::getline(in, line);) {
        ++line_number;
        const std::string_view text = std::string_view(line).substr(0, line.find('#'));
        if (split_words(text).empty()) continue;
        try {
            segments.push_back(parse_segment<Scalar>(text));
        } catch (const InputError& error) {
            throw InputError(name + ":" + std::to_string(line_number) + ": " + error.what());
        }
    }
    if (in.bad()) throw InputError(name + ": can't be read");
}

/// Short segments near the surface, each aimed at a random point of a random triangle, and through it.
class SegmentMaker {
  public:
    template <class Scalar>
    SegmentMaker(const pierce::TriangleSoup<Scalar>& soup, const Options& options)
        : random_(options.seed), length_(options.length ? *options.length : 4 * mean_edge_length(soup)) {}

    template <class Scalar>
    Segment<Scalar> make(const pierce::TriangleSoup<Scalar>& soup) {
        const auto corners = corners_of(soup, random_() % soup.triangles.size());
        double u = number(), v = number();
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        const Point target = corners[0] * (1 - u - v) + corners[1] * u + corners[2] * v;
        const Point way = direction() * length_;
        const double before = 0.05 + 0.9 * number();
        return {(target - before * way).template cast<Scalar>(), (target + (1 - before) * way).template cast<Scalar>()};
    }

  private:
    template <class Scalar>
    static std::array<Point, 3> corners_of(const pierce::TriangleSoup<Scalar>& soup, std::size_t triangle) {
        const auto& [a, b, c] = soup.triangles[triangle];
        return {soup.positions[a].template cast<double>(), soup.positions[b].template cast<double>(),
                soup.positions[c].template cast<double>()};
    }

    template <class Scalar>
    static double mean_edge_length(const pierce::TriangleSoup<Scalar>& soup) {
        double sum = 0;
        for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
            const auto [a, b, c] = corners_of(soup, i);
            sum += (b - a).stableNorm() + (c - b).stableNorm() + (a - c).stableNorm();
        }
        return sum / (3 * static_cast<double>(soup.triangles.size()));
    }

    /// Uniform in [0, 1). The distributions of the standard library differ from one implementation to the next.
    double number() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

    /// Uniform on the sphere: points of a cube, those outside of the ball thrown away.
    Point direction() {
        for (;;) {
            const double x = 2 * number() - 1, y = 2 * number() - 1, z = 2 * number() - 1;
            const Point point(x, y, z);
            if (const double length = point.norm(); length > 0.1 && length <= 1) return point / length;
        }
    }

    std::mt19937_64 random_;
    double length_;
};

}  // namespace

template <class Scalar>
std::vector<Segment<Scalar>> collect_segments(const Options& options, const pierce::TriangleSoup<Scalar>& soup) {
    std::vector<Segment<Scalar>> segments;
    if (options.segment_file == "-") {
        read_segments(std::cin, "standard input", segments);
    } else if (!options.segment_file.empty()) {
        std::ifstream file(options.segment_file);
        if (!file) throw InputError(options.segment_file + ": can't be opened");
        read_segments(file, options.segment_file, segments);
    }
    for (const std::string& text : options.segment_texts) {
        try {
            segments.push_back(parse_segment<Scalar>(text));
        } catch (const InputError& error) {
            throw InputError(std::string("cast: --segment: ") + error.what());
        }
    }
    if (options.random_count > 0) {
        SegmentMaker maker(soup, options);
        segments.reserve(segments.size() + options.random_count);
        for (std::uint64_t i = 0; i < options.random_count; ++i) segments.push_back(maker.make(soup));
    }
    return segments;
}

template std::vector<Segment<float>> collect_segments(const Options&, const pierce::TriangleSoup<float>&);
template std::vector<Segment<double>> collect_segments(const Options&, const pierce::TriangleSoup<double>&);

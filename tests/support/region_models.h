// Models of many regions that tests make for themselves: cubes in colours, and shells around one another that are
// divided by walls.
#pragma once

#include <sstream>
#include <string>

#include <pierce/label_report.h>
#include <pierce/ray.h>
#include <support/meshes.h>

namespace pierce::test {

/// Flights as text that is exact.
template <class Scalar>
std::string said(const Segment<Scalar>& way) {
    std::ostringstream out;
    out << std::hexfloat << "segment " << way.from.transpose() << " -> " << way.to.transpose();
    return out.str();
}
template <class Scalar>
std::string said(const Ray<Scalar>& way) {
    std::ostringstream out;
    out << std::hexfloat << "ray " << way.origin.transpose() << " along " << way.direction.transpose() << " to "
        << way.limit;
    return out.str();
}

template <class Scalar>
struct RegionModel {
    TriangleSoup<Scalar> soup;
    std::vector<FaceRegions> labels;

    template <class Other>
    [[nodiscard]] RegionModel<Other> as(double scale, const Vec3<double>& offset) const {
        return {moved<Other>(soup, scale, offset), labels};
    }
    void add(const RegionModel& more) {
        append(soup, more.soup);
        labels.insert(labels.end(), more.labels.begin(), more.labels.end());
    }
};

/// size^3 cells of some edge length, each in a colour from 0, which is that of everything around them, to `colours`.
/// Where two cells differ there are two triangles between them: random diagonals, turned at random.
struct ColouredCubes {
    ColouredCubes(int cells, int colours, int edge_length, std::uint64_t seed) : size(cells), edge(edge_length) {
        Random random(seed);
        colour.resize(static_cast<std::size_t>(size * size * size));
        for (std::uint32_t& c : colour)
            c = static_cast<std::uint32_t>(random.below(static_cast<std::size_t>(colours) + 1));
        std::map<std::array<int, 3>, std::uint32_t> index;
        const auto vertex = [&](const std::array<int, 3>& p) {
            const auto [at, isnew] = index.try_emplace(p, static_cast<std::uint32_t>(model.soup.positions.size()));
            if (isnew) model.soup.positions.push_back(Vec3<double>(p[0], p[1], p[2]) * edge);
            return at->second;
        };
        for (int x = -1; x < size; ++x)
            for (int y = -1; y < size; ++y)
                for (int z = -1; z < size; ++z)
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        const std::array<int, 3> low = {x, y, z};
                        std::array<int, 3> high = low;
                        ++high[axis];
                        if (at(low) == at(high)) continue;
                        std::array<std::uint32_t, 4> corner{};
                        for (std::size_t k = 0; k < 4; ++k) {  // around the square, counter-clockwise seen from high
                            std::array<int, 3> p = high;
                            p[(axis + 1) % 3] += (k == 1 || k == 2) ? 1 : 0;
                            p[(axis + 2) % 3] += k >= 2 ? 1 : 0;
                            corner[k] = vertex(p);
                        }
                        const std::size_t s = random.below(2);
                        add({corner[s], corner[s + 1], corner[s + 2]}, {at(high), at(low)}, random);
                        add({corner[s], corner[s + 2], corner[(s + 3) % 4]}, {at(high), at(low)}, random);
                    }
    }

    [[nodiscard]] std::uint32_t at(const std::array<int, 3>& cell) const {
        for (const int c : cell)
            if (c < 0 || c >= size) return 0;
        return colour[static_cast<std::size_t>((cell[0] * size + cell[1]) * size + cell[2])];
    }
    /// Of a point that is moved upwards along each axis by an infinitesimal step.
    [[nodiscard]] std::uint32_t at_moved(const Vec3<double>& p) const {
        const auto cell = [&](int k) {
            return static_cast<int>(std::clamp(std::floor(p[k] / edge), -1.0, static_cast<double>(size)));
        };
        return at({cell(0), cell(1), cell(2)});
    }

    int size;
    double edge;
    std::vector<std::uint32_t> colour;
    RegionModel<double> model;

  private:
    void add(IndexTriple triangle, FaceRegions label, Random& random) {
        if (random.chance(0.5)) {
            std::swap(triangle[1], triangle[2]);
            std::swap(label.front, label.behind);
        }
        model.soup.triangles.push_back(triangle);
        model.labels.push_back(label);
    }
};

/// Bumpy shells around one another, of 8 n^2 triangles each, the stretch between two of them divided into eight by
/// walls along the axes' planes. Region 1 is the inside of the first; then come eight for each stretch, by octant;
/// outside is 0.
inline RegionModel<double> divided_shells(int n, int shells) {
    RegionModel<double> model;
    const auto per_octant = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
    const auto radius = [](const Vec3<double>& d) {
        return 1 + 0.12 * std::sin(5 * d[0] + 1) * std::sin(4 * d[1]) * std::cos(3 * d[2]) +
               0.03 * std::sin(19 * d[0]) * std::sin(23 * d[1] + 2) * std::sin(17 * d[2]);
    };
    const auto region = [shells](int stretch, std::size_t octant) {
        if (stretch == 0) return 1U;
        return stretch == shells ? 0U
                                 : 2 + 8 * static_cast<std::uint32_t>(stretch - 1) + static_cast<std::uint32_t>(octant);
    };
    const TriangleSoup<double> unit = star(n, radius);
    const auto count = static_cast<std::uint32_t>(unit.positions.size());
    std::map<std::array<std::uint32_t, 2>, std::size_t> octant_of;  // of directed edges
    for (std::size_t t = 0; t < unit.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            octant_of[{unit.triangles[t][k], unit.triangles[t][(k + 1) % 3]}] = t / per_octant;
    for (int shell = 0; shell < shells; ++shell) {
        const std::uint32_t base = count * static_cast<std::uint32_t>(shell);
        for (const Vec3<double>& p : unit.positions) model.soup.positions.push_back((1 + 0.5 * shell) * p);
        for (std::size_t t = 0; t < unit.triangles.size(); ++t) {
            const IndexTriple& tri = unit.triangles[t];
            model.soup.triangles.push_back({base + tri[0], base + tri[1], base + tri[2]});
            model.labels.push_back({region(shell + 1, t / per_octant), region(shell, t / per_octant)});
        }
        if (shell + 1 == shells) break;
        for (const auto& [edge, left] : octant_of) {
            const std::size_t right = octant_of.at({edge[1], edge[0]});
            if (left >= right) continue;
            // Its front looks to the right of the edge, seen from outside.
            const FaceRegions label{region(shell + 1, right), region(shell + 1, left)};
            const std::uint32_t u = base + edge[0];
            const std::uint32_t v = base + edge[1];
            model.soup.triangles.push_back({u, v, v + count});
            model.soup.triangles.push_back({u, v + count, u + count});
            model.labels.insert(model.labels.end(), 2, label);
        }
    }
    return model;
}

/// Those shells, and in the middle of the first cubes that touch in faces, edges and vertices: some 40 regions in all.
inline RegionModel<double> nested_model(int n, std::uint64_t seed) {
    RegionModel<double> model = divided_shells(n, 4);
    constexpr std::uint32_t k_first = 2 + 8 * 3;
    ColouredCubes cubes(5, 8, 1, seed);
    cubes.model.soup = moved<double>(cubes.model.soup, 0.125, Vec3<double>(-0.3125, -0.3125, -0.3125));
    for (FaceRegions& label : cubes.model.labels)
        for (std::uint32_t* region : {&label.front, &label.behind}) *region = *region == 0 ? 1 : k_first + *region;
    model.add(cubes.model);
    return model;
}

}  // namespace pierce::test

// Which closed triangles a point lies in, by CGAL's exact predicates, one triangle after the other.
#pragma once

#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <pierce/mesh_view.h>

namespace pierce::test {

class TouchOracle {
  public:
    template <class Scalar>
    explicit TouchOracle(const MeshView<Scalar>& mesh) {
        const auto at = [&](std::uint32_t v) { return to_cgal(mesh.positions[v]); };
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const IndexTriple& t = mesh.triangles[i];
            const Kernel::Triangle_3 triangle(at(t[0]), at(t[1]), at(t[2]));
            if (!triangle.is_degenerate()) triangles_.push_back({mesh.face_of(i), std::uint32_t(i), triangle});
        }
    }

    struct Found {
        std::uint32_t face;
        std::uint32_t triangle;
        friend auto operator<=>(const Found&, const Found&) = default;
    };

    /// In order of (face, triangle).
    template <class Scalar>
    [[nodiscard]] std::vector<Found> touched(const Vec3<Scalar>& point) const {
        std::vector<Found> found;
        for (const Entry& entry : triangles_)
            if (entry.triangle.has_on(to_cgal(point))) found.push_back({entry.face, entry.number});
        std::sort(found.begin(), found.end());
        return found;
    }

  private:
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    struct Entry {
        std::uint32_t face;
        std::uint32_t number;
        Kernel::Triangle_3 triangle;
    };
    template <class Scalar>
    static Kernel::Point_3 to_cgal(const Vec3<Scalar>& p) {
        return {double(p[0]), double(p[1]), double(p[2])};
    }

    std::vector<Entry> triangles_;
};

}  // namespace pierce::test

// Meshes that move: the types that several parts of the module know.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include <pierce/pierce.h>
#include <python/arrays.h>
#include <python/columns.h>
#include <python/mesh.h>

namespace pierce::python {

/// One step of a deforming mesh; it stays as it is.
class Step {
  public:
    template <class Scalar>
    using Kept = std::shared_ptr<const DeformationStep<Scalar>>;

    template <class Scalar>
    Step(DeformationStep<Scalar> step, const FaceCount& faces)
        : kept_(Kept<Scalar>(std::make_shared<DeformationStep<Scalar>>(std::move(step)))), flags_(faces) {}

    /// Calls `ask(const DeformationStep<Scalar>&)`.
    template <class Ask>
    auto ask(Ask&& ask) const {
        return std::visit([&](const auto& step) { return ask(*step); }, kept_);
    }
    /// The mesh at one end: it keeps the step.
    [[nodiscard]] Mesh end(bool after) const {
        return std::visit(
            [&]<class Scalar>(const Kept<Scalar>& step) {
                return Mesh(Mesh::Kept<Scalar>(step, after ? &step->after() : &step->before()), flags_);
            },
            kept_);
    }
    [[nodiscard]] bool is_double() const { return kept_.index() == 1; }
    /// As of a `Mesh`.
    [[nodiscard]] const FaceCount& flags() const { return flags_; }

  private:
    std::variant<Kept<float>, Kept<double>> kept_;
    FaceCount flags_;
};

/// Rotation and translation.
inline Pose<double> pose_of(const py::object& rotation, const py::object& translation) {
    Pose<double> pose;
    const auto rows = points_of<double>(rotation, "rotation");
    if (rows.view.size() != 3)
        throw py::value_error("rotation: shape " + shape_of(rows.owner) + ", where (3, 3) is needed");
    for (int i = 0; i < 3; ++i) pose.rotation.row(i) = rows.view[static_cast<std::size_t>(i)].transpose();
    pose.translation = vector_of<double>(translation, "translation");
    return pose;
}
py::tuple given_back(const Pose<double>& pose);

/// What all hits of a mesh that moves have in common. `Hit`: SweepHit or RigidHit.
template <class Scalar, class Hit>
void add_sweep_columns(Gathered<std::optional<Hit>>& out) {
    out.hit();
    out.template column<Scalar>("time", [](const Hit& hit) { return hit.time; });
    out.template vectors<Scalar>("place", [](const Hit& hit) { return hit.place; });
    out.template column<bool>("place_verified", [](const Hit& hit) { return hit.place_verified; });
    out.template vectors<Scalar>("position", [](const Hit& hit) { return hit.position; });
    out.template vectors<Scalar>("normal", [](const Hit& hit) { return hit.normal; });
    out.template vectors<Scalar>("barycentric", [](const Hit& hit) { return hit.barycentric; });
    out.template vectors<Scalar>("surface_motion", [](const Hit& hit) { return hit.surface_motion; });
}

/// Columns of the hits of a mesh that moves without a turn, or deforms.
template <class Scalar>
Gathered<std::optional<SweepHit<Scalar>>> columns_of_sweeps(std::size_t size) {
    Gathered<std::optional<SweepHit<Scalar>>> out(size);
    add_sweep_columns<Scalar>(out);
    out.face();
    out.feature();
    return out;
}

}  // namespace pierce::python

// Particles that slide along what they meet, bounce off it or come to rest: whole steps of many of them.
#include <algorithm>
#include <span>
#include <vector>

#include <python/bind.h>
#include <python/motion.h>
#include <python/options.h>
#include <python/work.h>

namespace pierce::python {

namespace {

// What surfaces do: one number for all faces, or one for each by its number.
template <class Scalar>
class Surfaces {
  public:
    Surfaces(const py::object& restitution, const py::object& friction, const Response<Scalar>& base,
             const FaceCount& faces)
        : restitution_(of(restitution, "restitution", faces)), friction_(of(friction, "friction", faces)), base_(base) {
        base_.restitution = restitution_.one;
        base_.friction = friction_.one;
    }
    // Has to live as long as the options.
    void enter(MoveOptions<Scalar>& options) const {
        options.response = base_;
        if (!restitution_.many() && !friction_.many()) return;
        options.response_at = [this](const MoveContact<Scalar>& contact) {
            Response<Scalar> response = base_;
            response.restitution = at(restitution_, contact.face);
            response.friction = at(friction_, contact.face);
            return response;
        };
    }

  private:
    static Values<Scalar> of(const py::object& given, const char* what, const FaceCount& faces) {
        const bool is_number = PyFloat_Check(given.ptr()) || PyLong_Check(given.ptr());
        const py::array array = is_number ? py::array() : array_of(given);
        const std::size_t size = is_number || array.ndim() == 0 ? 1 : static_cast<std::size_t>(array.shape(0));
        Values<Scalar> values = is_number ? values_of<Scalar>(given, what, size) : values_of<Scalar>(array, what, size);
        if (values.many()) faces.check(what, size);
        return values;
    }
    static Scalar at(const Values<Scalar>& values, std::uint32_t face) {
        if (!values.many()) return values.one;
        return face < values.size ? values.first[face] : Scalar{0};
    }

    Values<Scalar> restitution_;
    Values<Scalar> friction_;
    Response<Scalar> base_;
};

template <class Scalar>
Gathered<Move<Scalar>> columns_of_moves(std::size_t size) {
    using M = Move<Scalar>;
    Gathered<M> out(size);
    // Eigen's vectors are given by reference.
    out.template vectors<Scalar>(
        "position", [](const M& move) -> const auto& { return move.position; });
    out.template vectors<Scalar>(
        "velocity", [](const M& move) -> const auto& { return move.velocity; });
    out.template vectors<Scalar>(
        "travel", [](const M& move) -> const auto& { return move.travel; });
    out.template vectors<Scalar>(
        "remainder", [](const M& move) -> const auto& { return move.remainder; });
    out.template column<std::int64_t>("contacts", [](const M& move) { return move.contacts; });
    out.template column<std::int32_t>("casts", [](const M& move) { return move.casts; });
    out.template column<std::uint8_t>("state", [](const M& move) { return move.state; });
    return out;
}

template <class Scalar>
Gathered<MoveContact<Scalar>> columns_of_contacts(std::size_t size) {
    using C = MoveContact<Scalar>;
    Gathered<C> out(size);
    out.template vectors<Scalar>("point", [](const C& contact) { return contact.point; });
    out.template vectors<Scalar>("normal", [](const C& contact) { return contact.normal; });
    out.template column<Scalar>("speed", [](const C& contact) { return contact.speed; });
    out.template column<Scalar>("seconds", [](const C& contact) { return contact.seconds; });
    out.face();
    return out;
}

template <class Scalar>
constexpr MoveContact<Scalar> no_contact() {
    MoveContact<Scalar> none{};
    none.face = none.triangle = no_face;
    return none;
}

template <class Target>
py::tuple moved(const Target& self, bool bounce, const py::object& positions, const py::object& velocities,
                double seconds, const py::object& radius, const py::object& restitution, const py::object& friction,
                const py::object& surface_velocity, double rest_speed, const py::object& sides, const py::object& mask,
                int max_casts, std::size_t contacts, int threads, const py::object& progress) {
    return self.ask([&](const auto& mesh) -> py::tuple {
        using Scalar = ScalarOf<decltype(mesh)>;
        const auto given = pairs_of<Scalar>(bounce ? "move_and_bounce" : "move_and_slide", positions, "positions",
                                            velocities, "velocities");
        const auto radii = values_of<Scalar>(radius, "radius", given.size);
        const Filters filters(sides, std::numeric_limits<double>::infinity(), mask, self.flags());
        Response<Scalar> base;
        base.velocity = vector_of<Scalar>(surface_velocity, "surface_velocity");
        base.rest_speed = static_cast<Scalar>(rest_speed);
        const Surfaces<Scalar> surfaces(restitution, friction, base, self.flags());
        MoveOptions<Scalar> options;
        options.query = filters.options;
        options.max_casts = max_casts;
        options.radius = radii.one;
        surfaces.enter(options);
        const auto out = columns_of_moves<Scalar>(given.size);
        const auto out_contacts = columns_of_contacts<Scalar>(given.size * contacts);
        std::vector<Move<Scalar>> moves;
        std::vector<MoveContact<Scalar>> room;
        in_calls(given.size, {Threads(threads), progress},
                 [&](std::size_t first, std::size_t count, const Executor& executor) {
                     moves.resize(count);
                     room.assign(count * contacts, no_contact<Scalar>());
                     if (radii.many()) options.radii = radii.part(first, count);
                     const auto from = given.firsts(first, count);
                     const auto with = given.seconds(first, count);
                     const auto step = static_cast<Scalar>(seconds);
                     if (bounce)
                         moves_and_bounce<Scalar>(mesh, from, with, step, moves, options, executor, room);
                     else
                         moves_and_slide<Scalar>(mesh, from, with, step, moves, options, executor, room);
                     out.write(first, moves);
                     out_contacts.write(first * contacts, room);
                 });
        return py::make_tuple(out.columns, out_contacts.columns);
    });
}

}  // namespace

void bind_moves(MeshClass& mesh, StepClass& step) {
    mesh.def("moved", &moved<Mesh>);
    step.def("moved", &moved<Step>);
}

}  // namespace pierce::python

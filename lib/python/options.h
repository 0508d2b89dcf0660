// What may be chosen for a query, from what Python gives.
#pragma once

#include <string>

#include <pierce/pierce.h>
#include <python/arrays.h>

namespace pierce::python {

/// `"front"`, `"back"` or `"both"`, or their number.
inline Sides sides_of(const py::object& given) {
    if (PyIndex_Check(given.ptr()) != 0) {                                    // of NumPy as well
        const py::ssize_t number = PyNumber_AsSsize_t(given.ptr(), nullptr);  // clipped
        if (PyErr_Occurred() != nullptr) throw py::error_already_set();
        if (number >= 0 && number <= 2) return static_cast<Sides>(number);
    } else if (py::isinstance<py::str>(given)) {
        const auto word = given.cast<std::string>();
        if (word == "front") return Sides::front;
        if (word == "back") return Sides::back;
        if (word == "both") return Sides::both;
    }
    throw py::value_error("sides: " + std::string(py::repr(given)) + ", where 'front', 'back' or 'both' is needed");
}

/// Which faces count.
struct Filters {
    Mask mask;  ///< kept alive
    QueryOptions options;

    Filters(const py::object& sides, double max_fraction, const py::object& face_mask, const FaceCount& faces)
        : mask(mask_of(face_mask)) {
        if (!face_mask.is_none()) faces.check("mask", mask.view.size());
        options.sides = sides_of(sides);
        options.max_fraction = max_fraction;
        options.face_mask = mask.view;
    }
};

}  // namespace pierce::python

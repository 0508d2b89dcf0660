// What a caller in Python gives, as what the library reads: arrays of NumPy, without a copy where their memory allows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

#include <pierce/pierce.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

namespace pierce::python {

namespace py = pybind11;

/// Anything that NumPy makes an array of. What it can't is an error of NumPy's.
py::array array_of(const py::object& given);

/// `(4, 2)`, as NumPy prints shapes.
std::string shape_of(const py::array& array);

/// An array of `Scalar`, or for double of float, in the byte order of the machine: the caller's own where it is one.
/// Integers are converted exactly, others never to fewer digits: TypeError says how, ValueError names the first integer
/// that is too large.
template <class Scalar>
py::array numbers_of(const py::object& given, const char* what);

/// Points of an array that is kept alive.
template <class Scalar>
struct Points {
    py::array owner;
    PointsView<Scalar> view;
    bool alone = false;  ///< given as (3,): one point, for all where many are asked about
};

/// Shape (n, 3), or (3,) for one. Rows may lie anywhere; a row whose numbers are not side by side makes a copy.
template <class Scalar>
Points<Scalar> points_of(const py::object& given, const char* what);

/// The two ends, or parts, of `size` queries. One of them may be alone: it is repeated.
template <class Scalar>
struct Pairs {
    Points<Scalar> first;
    Points<Scalar> second;
    std::size_t size = 0;

    [[nodiscard]] PointsView<Scalar> firsts(std::size_t begin, std::size_t count) const {
        return first.view.part(begin, count);
    }
    [[nodiscard]] PointsView<Scalar> seconds(std::size_t begin, std::size_t count) const {
        return second.view.part(begin, count);
    }
    [[nodiscard]] Segments<Scalar> segments(std::size_t begin, std::size_t count) const {
        return {firsts(begin, count), seconds(begin, count)};
    }
};

/// ValueError, naming the call and both lengths, where these differ.
template <class Scalar>
Pairs<Scalar> pairs_of(const char* call, const py::object& first, const char* of_first, const py::object& second,
                       const char* of_second);

/// Three numbers that have to be such of `Scalar`, to the last bit.
template <class Scalar>
Vec3<Scalar> vector_of(const py::object& given, const char* what);

/// One number for all queries, or an array of one for each. A number of Python is rounded to `Scalar`, as by NumPy.
template <class Scalar>
struct Values {
    py::array owner;
    Scalar one = 0;
    const Scalar* first = nullptr;  ///< null: `one` is that of all
    std::size_t size = 0;

    [[nodiscard]] bool many() const { return first != nullptr; }
    [[nodiscard]] std::span<const Scalar> part(std::size_t begin, std::size_t count) const {
        return {first + begin, count};
    }
};

template <class Scalar>
Values<Scalar> values_of(const py::object& given, const char* what, std::size_t count);

/// Whole numbers from 0 to 2^32 - 1, side by side. Others are a `MeshError` that names the first one.
struct Numbers {
    py::array owner;
    std::span<const std::uint32_t> view;
};
Numbers whole_numbers_of(const py::object& given, const char* what);

/// The corners of triangles, shape (m, 3). Indices of 32 bits and unsigned ones of 16 are read where they are.
struct Triangles {
    py::array owner;
    TrianglesView view;
};
Triangles triangles_of(const py::object& given, const char* what);

/// Numbers or flags that are side by side in memory: None is empty. ValueError for more than one dimension.
struct Mask {
    py::array owner;
    std::span<const std::uint8_t> view;
};
Mask mask_of(const py::object& given);

/// How many entries an array needs that has one for each face, by its number.
struct FaceCount {
    std::size_t least = 0;  ///< one more than the largest number of a face
    bool exact = true;      ///< the faces are numbered by rows: more entries are one of another mesh

    /// ValueError where an array of this size is for other faces.
    void check(const char* what, std::size_t size) const;
};

/// A new array whose entries are not set, of shape (n,), or (n, 3) for points.
template <class Value>
py::array_t<Value> new_array(std::size_t size) {
    return py::array_t<Value>(static_cast<py::ssize_t>(size));
}
template <class Value>
py::array_t<Value> new_rows(std::size_t size) {
    return py::array_t<Value>({static_cast<py::ssize_t>(size), py::ssize_t{3}});
}

/// What the library writes flags and enumerators to: a bool of NumPy is a byte that is 0 or 1.
inline std::uint8_t* bytes_of(py::array_t<bool>& flags) {
    return static_cast<std::uint8_t*>(static_cast<void*>(flags.mutable_data()));
}

template <class Scalar>
inline constexpr const char* name_of = std::is_same_v<Scalar, float> ? "float32" : "float64";

}  // namespace pierce::python

// Which arrays are taken as they are, which are converted, and which are refused.
#include <python/arrays.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace pierce::python {

namespace {

bool is_native(const py::array& array) { return array.dtype().attr("isnative").cast<bool>(); }

std::string text_of(const py::handle& value) { return py::str(value); }

[[noreturn]] void refuse_type(const char* what, const py::array& array, const std::string& why) {
    throw py::type_error(std::string(what) + ": dtype " + text_of(array.dtype()) + ' ' + why);
}
[[noreturn]] void refuse_shape(const char* what, const py::array& array, const char* wanted) {
    throw py::value_error(std::string(what) + ": shape " + shape_of(array) + ", where " + wanted + " is needed");
}

py::array converted(const py::array& array, const char* dtype) { return array.attr("astype")(dtype, "C"); }

// Of 0 to 2^53 (float: 2^24) all whole numbers are exact.
template <class Scalar>
py::array of_integers(const py::array& array, const char* what) {
    const auto most = std::int64_t{1} << std::numeric_limits<Scalar>::digits;
    if (array.size() != 0) {
        const py::int_ largest(array.attr("max")());
        const py::int_ least(array.attr("min")());
        const bool fits = largest <= py::int_(most) && least >= py::int_(-most);
        if (!fits)
            throw py::value_error(std::string(what) + ": integers from " + text_of(least) + " to " + text_of(largest) +
                                  " are not all exact in " + name_of<Scalar>);
    }
    return converted(array, name_of<Scalar>);
}

// The last axis has to be three numbers side by side.
bool has_whole_rows(const py::array& array) { return array.strides(1) == array.itemsize(); }

py::array side_by_side(const py::array& array) { return py::module_::import("numpy").attr("ascontiguousarray")(array); }

}  // namespace

py::array array_of(const py::object& given) {
    if (py::isinstance<py::array>(given)) return py::reinterpret_borrow<py::array>(given);
    return py::module_::import("numpy").attr("asarray")(given);
}

std::string shape_of(const py::array& array) { return py::str(array.attr("shape")); }

template <class Scalar>
py::array numbers_of(const py::object& given, const char* what) {
    py::array array = array_of(given);
    const char kind = array.dtype().kind();
    const py::ssize_t bytes = array.itemsize();
    if (kind == 'i' || kind == 'u') return of_integers<Scalar>(array, what);
    if (kind != 'f') refuse_type(what, array, "is no kind of number that a mesh has");
    if (array.size() == 0) return converted(array, name_of<Scalar>);
    if (bytes > py::ssize_t{sizeof(double)}) refuse_type(what, array, "has more digits than float64: round it first");
    if (bytes > py::ssize_t{sizeof(Scalar)})
        refuse_type(what, array,
                    std::string("on a float32 mesh: round it yourself, ") + what +
                        ".astype(numpy.float32), or make the mesh of float64 vertices");
    if (bytes < py::ssize_t{sizeof(float)}) return converted(array, "float32");
    return is_native(array) ? array : converted(array, bytes == sizeof(float) ? "float32" : "float64");
}

template <class Scalar>
Points<Scalar> points_of(const py::object& given, const char* what) {
    Points<Scalar> points;
    py::array& array = points.owner = numbers_of<Scalar>(given, what);
    points.alone = array.ndim() == 1 && array.shape(0) == 3;
    if (array.ndim() == 1 && array.shape(0) == 0) return points;
    if (points.alone) array = array.attr("reshape")(1, 3);
    if (array.ndim() != 2 || array.shape(1) != 3) refuse_shape(what, array, "(n, 3)");
    if (!has_whole_rows(array)) array = side_by_side(array);
    const auto size = static_cast<std::size_t>(array.shape(0));
    const py::ssize_t stride = array.strides(0);
    if constexpr (std::is_same_v<Scalar, double>)
        if (array.itemsize() == sizeof(float)) {
            points.view = {static_cast<const float*>(array.data()), size, stride};
            return points;
        }
    points.view = {static_cast<const Scalar*>(array.data()), size, stride};
    return points;
}

namespace {

// The one point `count` times: no step leads from each to the next.
template <class Scalar>
void repeat(Points<Scalar>& points, std::size_t count) {
    const py::array& array = points.owner;
    if constexpr (std::is_same_v<Scalar, double>)
        if (array.itemsize() == sizeof(float)) {
            points.view = {static_cast<const float*>(array.data()), count, 0};
            return;
        }
    points.view = {static_cast<const Scalar*>(array.data()), count, 0};
}

}  // namespace

template <class Scalar>
Pairs<Scalar> pairs_of(const char* call, const py::object& first, const char* of_first, const py::object& second,
                       const char* of_second) {
    Pairs<Scalar> pairs{points_of<Scalar>(first, of_first), points_of<Scalar>(second, of_second)};
    if (pairs.first.alone) repeat(pairs.first, pairs.second.view.size());
    if (pairs.second.alone) repeat(pairs.second, pairs.first.view.size());
    pairs.size = pairs.first.view.size();
    if (pairs.size != pairs.second.view.size())
        throw std::invalid_argument(std::string(call) + ": " + std::to_string(pairs.size) + ' ' + of_first + " and " +
                                    std::to_string(pairs.second.view.size()) + ' ' + of_second);
    return pairs;
}

template <class Scalar>
Vec3<Scalar> vector_of(const py::object& given, const char* what) {
    const py::array array = array_of(given);
    if (array.ndim() != 1 || array.shape(0) != 3) refuse_shape(what, array, "(3,)");
    const Points<double> points = points_of<double>(array, what);
    const Vec3<double> exact = points.view[0];
    const Vec3<Scalar> vector = exact.cast<Scalar>();
    for (int k = 0; k < 3; ++k)
        if (std::isfinite(exact[k]) && static_cast<double>(vector[k]) != exact[k])
            throw py::type_error(std::string(what) + ": " + text_of(py::float_(exact[k])) +
                                 " is no float32 number, as the mesh has: round it yourself, numpy.float32(...)");
    return vector;
}

template <class Scalar>
Values<Scalar> values_of(const py::object& given, const char* what, std::size_t count) {
    Values<Scalar> values;
    if (PyFloat_Check(given.ptr()) || PyLong_Check(given.ptr())) {
        const double number = PyFloat_AsDouble(given.ptr());
        if (PyErr_Occurred() != nullptr) throw py::error_already_set();  // OverflowError: an integer that is too large
        values.one = static_cast<Scalar>(number);
        return values;
    }
    values.owner = numbers_of<Scalar>(given, what);
    if (values.owner.itemsize() != sizeof(Scalar)) values.owner = converted(values.owner, name_of<Scalar>);
    if (values.owner.ndim() == 0) {
        values.one = *static_cast<const Scalar*>(values.owner.data());
        return values;
    }
    if (values.owner.ndim() != 1 || static_cast<std::size_t>(values.owner.shape(0)) != count)
        refuse_shape(what, values.owner, ("one number, or (" + std::to_string(count) + ",),").c_str());
    values.owner = side_by_side(values.owner);
    values.first = static_cast<const Scalar*>(values.owner.data());
    values.size = count;
    return values;
}

namespace {

// Names the first entry that is none.
py::array as_indices(const py::array& array, const char* what) {
    const char kind = array.dtype().kind();
    if (kind != 'i' && kind != 'u') refuse_type(what, array, "where whole numbers are needed");
    if (array.size() != 0) {
        constexpr std::int64_t k_most = std::numeric_limits<std::uint32_t>::max();
        for (const char* const end : {"argmin", "argmax"}) {
            const py::int_ place(array.attr(end)());
            const py::int_ value(py::object(array.attr("flat")[place]));
            if (value >= py::int_(0) && value <= py::int_(k_most)) continue;
            const py::ssize_t row = py::ssize_t{place} / (array.ndim() == 2 ? array.shape(1) : 1);
            throw MeshError(std::string(what) + ": " + text_of(value) + " in row " + std::to_string(row) +
                            " is not the number of a vertex or face");
        }
    }
    return converted(array, "uint32");
}

}  // namespace

Numbers whole_numbers_of(const py::object& given, const char* what) {
    Numbers numbers;
    const py::array array = array_of(given);
    if (array.ndim() != 1) refuse_shape(what, array, "(n,)");
    if (array.size() == 0) return numbers;
    numbers.owner = as_indices(array, what);
    numbers.view = {static_cast<const std::uint32_t*>(numbers.owner.data()),
                    static_cast<std::size_t>(numbers.owner.size())};
    return numbers;
}

Triangles triangles_of(const py::object& given, const char* what) {
    Triangles triangles;
    py::array& array = triangles.owner = array_of(given);
    if (array.ndim() == 1 && array.size() == 0) return triangles;
    if (array.ndim() != 2 || array.shape(1) != 3) refuse_shape(what, array, "(m, 3)");
    const char kind = array.dtype().kind();
    const bool is_short = kind == 'u' && array.itemsize() == sizeof(std::uint16_t);
    const bool is_unsigned = kind == 'u' && array.itemsize() == sizeof(std::uint32_t);
    const bool as_it_is = (is_short || is_unsigned) && is_native(array) && has_whole_rows(array);
    if (!as_it_is) array = as_indices(array, what);
    const auto size = static_cast<std::size_t>(array.shape(0));
    if (as_it_is && is_short)
        triangles.view = {static_cast<const std::uint16_t*>(array.data()), size, array.strides(0)};
    else
        triangles.view = {static_cast<const std::uint32_t*>(array.data()), size, array.strides(0)};
    return triangles;
}

Mask mask_of(const py::object& given) {
    Mask mask;
    if (given.is_none()) return mask;
    mask.owner = array_of(given);
    const char kind = mask.owner.dtype().kind();
    if (kind != 'b' && kind != 'u' && kind != 'i') refuse_type("mask", mask.owner, "where flags are needed");
    if (mask.owner.ndim() != 1) refuse_shape("mask", mask.owner, "(number of faces,)");
    if (mask.owner.itemsize() != 1) mask.owner = converted(mask.owner, "bool");
    mask.owner = side_by_side(mask.owner);
    mask.view = {static_cast<const std::uint8_t*>(mask.owner.data()), static_cast<std::size_t>(mask.owner.size())};
    return mask;
}

void FaceCount::check(const char* what, std::size_t size) const {
    if (size == least || (size > least && !exact)) return;
    throw py::value_error(std::string(what) + ": " + std::to_string(size) + " entries, where " +
                          (exact ? "" : "at least ") + std::to_string(least) + " are needed, one for each face");
}

template py::array numbers_of<float>(const py::object&, const char*);
template py::array numbers_of<double>(const py::object&, const char*);
template Points<float> points_of(const py::object&, const char*);
template Points<double> points_of(const py::object&, const char*);
template Pairs<float> pairs_of(const char*, const py::object&, const char*, const py::object&, const char*);
template Pairs<double> pairs_of(const char*, const py::object&, const char*, const py::object&, const char*);
template Vec3<float> vector_of(const py::object&, const char*);
template Vec3<double> vector_of(const py::object&, const char*);
template Values<float> values_of(const py::object&, const char*, std::size_t);
template Values<double> values_of(const py::object&, const char*, std::size_t);

}  // namespace pierce::python

// What a program in C gives, as what the C++ interface takes. What is missing is an std::invalid_argument that names
// the function.
#pragma once

#include <cstring>
#include <span>
#include <stdexcept>
#include <string>

#include <pierce/pierce.h>
#include <pierce/pierce_c.h>

namespace pierce::detail {

/// The C function that was called, by its name.
struct Caller {
    const char* name;

    [[noreturn]] void refuse(const std::string& why) const {
        throw std::invalid_argument(std::string(name) + ": " + why);
    }
    template <class Value>
    Value& given(Value* value, const char* what) const {
        if (value == nullptr) refuse(std::string(what) + " is null");
        return *value;
    }
    /// An array: null only if nothing is in it.
    template <class Value>
    std::span<Value> array(Value* values, std::size_t size, const char* what) const {
        if (values == nullptr && size != 0) refuse(std::string(what) + " is null");
        return {values, size};
    }
};

/// The number of an enumerator, which may be one that its type has no room for.
template <class Enumeration>
int number_of(const Enumeration& enumerator) {
    static_assert(sizeof(Enumeration) == sizeof(int));
    int number = 0;
    std::memcpy(&number, &enumerator, sizeof number);
    return number;
}

/// What is a C structure out here and a C++ one in there, byte for byte (layout.h).
template <class Inside, class Outside>
Inside* same_bytes(Outside* values) {
    static_assert(sizeof(Inside) == sizeof(Outside) && alignof(Inside) == alignof(Outside));
    return reinterpret_cast<Inside*>(values);
}

/// Room for answers of a single query: none if the pointer is null.
template <class Inside, class Outside>
std::span<Inside> room(Outside* values, std::size_t capacity) {
    return {same_bytes<Inside>(values), values == nullptr ? 0 : capacity};
}

template <class Scalar>
Vec3<Scalar> vector_of(const Scalar* numbers) {
    return {numbers[0], numbers[1], numbers[2]};
}

template <class Number>
std::ptrdiff_t stride_or(std::ptrdiff_t stride, std::ptrdiff_t numbers) {
    return stride != 0 ? stride : numbers * static_cast<std::ptrdiff_t>(sizeof(Number));
}

inline PointsView<float> points_of(const Caller& caller, const pierce_points_f& points, const char* what) {
    (void)caller.array(points.first, points.count, what);
    return {points.first, points.count, stride_or<float>(points.stride, 3)};
}
inline PointsView<double> points_of(const Caller& caller, const pierce_points_d& points, const char* what) {
    if (points.first == nullptr && points.floats != nullptr)
        return {points.floats, points.count, stride_or<float>(points.stride, 3)};
    (void)caller.array(points.first, points.count, what);
    return {points.first, points.count, stride_or<double>(points.stride, 3)};
}

inline TrianglesView triangles_of(const Caller& caller, const pierce_triangles& triangles) {
    if (triangles.first == nullptr && triangles.shorts != nullptr)
        return {triangles.shorts, triangles.count, stride_or<std::uint16_t>(triangles.stride, 3)};
    (void)caller.array(triangles.first, triangles.count, "triangles.first");
    return {triangles.first, triangles.count, stride_or<std::uint32_t>(triangles.stride, 3)};
}

template <class Scalar, class GivenSegments>
Segments<Scalar> segments_of(const Caller& caller, const GivenSegments* segments) {
    const GivenSegments& all = caller.given(segments, "segments");
    return {points_of(caller, all.from, "segments.from.first"), points_of(caller, all.to, "segments.to.first")};
}

template <class Scalar, class GivenRays>
Rays<Scalar> rays_of(const Caller& caller, const GivenRays* rays) {
    const GivenRays& all = caller.given(rays, "rays");
    const auto origins = points_of(caller, all.origins, "rays.origins.first");
    const auto directions = points_of(caller, all.directions, "rays.directions.first");
    const auto limits = caller.array(all.limits, all.limit_count, "rays.limits");
    if (limits.empty()) return {origins, directions};
    if (limits.size() == 1) return {origins, directions, limits[0]};
    if (limits.size() != origins.size())
        caller.refuse(std::to_string(origins.size()) + " origins and " + std::to_string(limits.size()) + " limits");
    return {origins, directions, all.limits, stride_or<Scalar>(all.limit_stride, 1)};
}

extern "C" {
inline void pierce_run_task(void* data, std::size_t part) { (*static_cast<const Task*>(data))(part); }
}

inline Executor executor_of(const pierce_executor* executor) {
    if (executor == nullptr || executor->run == nullptr) return {};
    return [run = executor->run, user = executor->user](std::size_t parts, Task task) {
        run(parts, &pierce_run_task, &task, user);
    };
}

}  // namespace pierce::detail

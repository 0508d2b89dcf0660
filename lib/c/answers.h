// What the C++ interface answers, as what a program in C gets; and the message of the thread's last failure.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <c/given.h>
#include <without_exceptions.h>

namespace pierce::detail {

inline std::string& last_message() noexcept {
    thread_local std::string message;
    return message;
}

/// Calls `call(caller)`, and keeps what was wrong with it.
template <class Call>
pierce_status guarded(const char* name, Call&& call, Status of_mesh = Status::bad_mesh) noexcept {
    const Status status = without_exceptions([&] { call(Caller{name}); }, of_mesh, last_message());
    return static_cast<pierce_status>(status);
}

template <class Scalar, class Outside>
bool give_no_hit(Outside* out) noexcept {
    if (out != nullptr) *same_bytes<Hit<Scalar>>(out) = no_hit<Scalar>;
    return false;
}

/// Writes the hit, or that there is none, and returns whether there is one.
template <class Scalar, class Outside>
bool give(const std::optional<Hit<Scalar>>& hit, Outside* out) noexcept {
    if (!hit) return give_no_hit<Scalar>(out);
    if (out != nullptr) *same_bytes<Hit<Scalar>>(out) = *hit;
    return true;
}

inline void give(std::size_t count, std::size_t* out) noexcept {
    if (out != nullptr) *out = count;
}

/// As much of the text as there is room for, with a 0 behind it.
inline void give(const std::string& whole, char* text, std::size_t size, std::size_t* length) noexcept {
    give(whole.size(), length);
    if (text == nullptr || size == 0) return;
    text[whole.copy(text, size - 1)] = '\0';
}

/// Null where the face has none.
inline const char* name_of(const std::vector<std::string>& names, const std::vector<std::uint32_t>& name_of_face,
                           std::uint32_t face) noexcept {
    if (face >= name_of_face.size() || name_of_face[face] == k_no_name) return nullptr;
    return names[name_of_face[face]].c_str();
}

template <class Scalar, class Outside>
bool give(const RegionPlace<Scalar>& place, Outside& out) noexcept {
    std::copy_n(place.point.data(), 3, out.point);
    out.region = place.region;
    out.reached = place.reached;
    return place.reached;
}

template <class Scalar, class Arrays>
HitArrays<Scalar> arrays_of(const Arrays& arrays, std::size_t count) noexcept {
    HitArrays<Scalar> out;
    out.count = count;
    out.hit = arrays.hit;
    out.fraction = arrays.fraction;
    out.exact_fraction = arrays.exact_fraction;
    out.point = arrays.point;
    out.position = arrays.position;
    out.normal = arrays.normal;
    out.barycentric = arrays.barycentric;
    out.face = arrays.face;
    out.triangle = arrays.triangle;
    out.side = same_bytes<Sides>(arrays.side);
    out.feature = same_bytes<Feature>(arrays.feature);
    out.feature_index = arrays.feature_index;
    out.at_start = arrays.at_start;
    return out;
}

}  // namespace pierce::detail

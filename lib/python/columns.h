// Answers as a dict of arrays, one for each of their members.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <pierce/pierce.h>
#include <python/arrays.h>

namespace pierce::python {

/// What the caller wants of the answers: None for all of it, a name, or names. What is not known is a ValueError.
class Wanted {
  public:
    template <std::size_t size>
    Wanted(const py::object& given, const std::array<std::string_view, size>& known) : all_(given.is_none()) {
        if (all_) return;
        names_ = py::isinstance<py::str>(given) ? py::set(py::make_tuple(given)) : py::set(given);
        for (const py::handle& name : names_) {
            bool is_known = false;
            for (const std::string_view one : known) is_known |= py::str(name).cast<std::string>() == one;
            if (!is_known) throw py::value_error("wanted: there is no " + std::string(py::repr(name)));
        }
    }
    [[nodiscard]] bool operator()(std::string_view name) const {
        return all_ || names_.contains(py::str(name.data(), name.size()));
    }

  private:
    bool all_;
    py::set names_;
};

/// Hits that the library writes to arrays of NumPy itself.
template <class Scalar>
class HitColumns {
  public:
    static constexpr std::array<std::string_view, 13> k_names = {
        "hit",  "fraction", "exact_fraction", "point",   "position",      "normal",  "barycentric",
        "face", "triangle", "side",           "feature", "feature_index", "at_start"};

    HitColumns(std::size_t size, const py::object& wanted) {
        const Wanted wants(wanted, k_names);
        arrays_.count = size;
        py::array_t<bool> hit = new_array<bool>(size);  // always: it says what the others mean
        columns["hit"] = hit;
        arrays_.hit = bytes_of(hit);
        const auto numbers = [&](const char* name, auto& pointer, auto make) {
            if (!wants(name)) return;
            auto array = make(size);
            columns[name] = array;
            pointer = reinterpret_cast<std::remove_reference_t<decltype(pointer)>>(array.mutable_data());
        };
        numbers("fraction", arrays_.fraction, new_array<Scalar>);
        numbers("exact_fraction", arrays_.exact_fraction, new_array<Scalar>);
        numbers("point", arrays_.point, new_rows<Scalar>);
        numbers("position", arrays_.position, new_rows<Scalar>);
        numbers("normal", arrays_.normal, new_rows<Scalar>);
        numbers("barycentric", arrays_.barycentric, new_rows<Scalar>);
        numbers("face", arrays_.face, new_array<std::uint32_t>);
        numbers("triangle", arrays_.triangle, new_array<std::uint32_t>);
        numbers("side", arrays_.side, new_array<std::uint8_t>);
        numbers("feature", arrays_.feature, new_array<std::uint8_t>);
        numbers("feature_index", arrays_.feature_index, new_array<std::uint8_t>);
        numbers("at_start", arrays_.at_start, new_array<bool>);
    }

    /// Where the answers `first` up to `first + count` go, without that.
    [[nodiscard]] HitArrays<Scalar> part(std::size_t first, std::size_t count) const {
        HitArrays<Scalar> some = arrays_;
        some.count = count;
        const auto on = [first](auto*& pointer, std::size_t each = 1) {
            if (pointer != nullptr) pointer += each * first;
        };
        on(some.hit), on(some.fraction), on(some.exact_fraction);
        on(some.point, 3), on(some.position, 3), on(some.normal, 3), on(some.barycentric, 3);
        on(some.face), on(some.triangle), on(some.side), on(some.feature), on(some.feature_index), on(some.at_start);
        return some;
    }

    py::dict columns;

  private:
    HitArrays<Scalar> arrays_;
};

/// What an array of the library's structures has at a place: the answer, or null where there is none.
template <class Answer>
const Answer* answer_at(const Answer& answer) {
    return &answer;
}
template <class Answer>
const Answer* answer_at(const std::optional<Answer>& answer) {
    return answer ? &*answer : nullptr;
}

/// Columns of answers that the library gives as structures, or optional ones: these are written part by part, by
/// threads without the lock. Of what is no answer all is 0, but where `missing` says else.
template <class Row>
class Gathered {
    using Answer = std::remove_cvref_t<decltype(*answer_at(std::declval<const Row&>()))>;

  public:
    explicit Gathered(std::size_t size, const Wanted* wanted = nullptr) : size_(size), wanted_(wanted) {}

    template <class Value, class Get>
    void column(const char* name, Get get, Value missing = {}) {
        if (!wants(name)) return;
        auto array = new_array<Value>(size_);
        columns[name] = array;
        writers_.push_back([out = array.mutable_data(), get, missing](std::size_t first, std::span<const Row> rows) {
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const Answer* const answer = answer_at(rows[i]);
                out[first + i] = answer != nullptr ? static_cast<Value>(get(*answer)) : missing;
            }
        });
    }
    /// Of three numbers each: `get` gives something with [0], [1] and [2].
    template <class Scalar, class Get>
    void vectors(const char* name, Get get) {
        if (!wants(name)) return;
        auto array = new_rows<Scalar>(size_);
        columns[name] = array;
        writers_.push_back([out = array.mutable_data(), get](std::size_t first, std::span<const Row> rows) {
            for (std::size_t i = 0; i < rows.size(); ++i)
                for (std::size_t k = 0; k < 3; ++k) {
                    const Answer* const answer = answer_at(rows[i]);
                    out[3 * (first + i) + k] = answer != nullptr ? get(*answer)[static_cast<int>(k)] : Scalar{0};
                }
        });
    }
    /// Whether there is an answer.
    void hit() {
        column<bool>("hit", [](const Answer&) { return true; });
    }
    /// What all kinds of hits say of the face.
    void face() {
        column<std::uint32_t>(
            "face", [](const Answer& one) { return one.face; }, no_face);
        column<std::uint32_t>(
            "triangle", [](const Answer& one) { return one.triangle; }, no_face);
        column<std::uint8_t>("side", [](const Answer& one) { return one.side; });
    }
    void feature() {
        column<std::uint8_t>("feature", [](const Answer& one) { return one.feature; });
        column<std::uint8_t>("feature_index", [](const Answer& one) { return one.feature_index; });
        column<bool>("at_start", [](const Answer& one) { return one.at_start; });
    }

    /// Answers `first` and so on.
    void write(std::size_t first, std::span<const Row> rows) const {
        for (const auto& writer : writers_) writer(first, rows);
    }

    py::dict columns;

  private:
    [[nodiscard]] bool wants(const char* name) const { return wanted_ == nullptr || (*wanted_)(name); }

    std::size_t size_;
    const Wanted* wanted_;
    std::vector<std::function<void(std::size_t, std::span<const Row>)>> writers_;
};

}  // namespace pierce::python

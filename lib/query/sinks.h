// Where the answers of a batch go. A sink has
//   clear(i)          answer i is a miss, so far; it is not looked at before, which would wait for memory (8 % of the
//                     time of a batch)
//   put(i, write)     answer i is the hit that write(Hit&) writes, where that is possible to its place at once
#pragma once

#include <cstring>
#include <memory>

#include <pierce/batch.h>

namespace pierce::detail {

template <class Scalar>
struct OptionalHits {
    std::optional<Hit<Scalar>>* out;

    void clear(std::size_t i) const {
        static_assert(std::is_trivially_destructible_v<std::optional<Hit<Scalar>>>);
        std::construct_at(out + i);
    }
    template <class Write>
    void put(std::size_t i, Write&& write) const {
        write(out[i].emplace());
    }
};

template <class Scalar>
struct PlainHits {
    Hit<Scalar>* out;

    void clear(std::size_t i) const { out[i] = no_hit<Scalar>; }
    template <class Write>
    void put(std::size_t i, Write&& write) const {
        write(out[i]);
    }
};

template <class Scalar>
struct ArraysOfHits {
    HitArrays<Scalar> out;

    void clear(std::size_t i) const { scatter(i, no_hit<Scalar>); }
    template <class Write>
    void put(std::size_t i, Write&& write) const {
        Hit<Scalar> hit{};
        write(hit);
        scatter(i, hit);
    }
    void scatter(std::size_t i, const Hit<Scalar>& hit) const {
        const auto set = [i](auto* array, auto value) {
            if (array != nullptr) array[i] = value;
        };
        const auto set_three = [i](Scalar* array, const Coordinates<Scalar>& value) {
            if (array != nullptr) std::memcpy(array + 3 * i, value.data(), sizeof value);
        };
        const auto flag = [](bool is) { return static_cast<std::uint8_t>(is ? 1 : 0); };
        set(out.hit, flag(static_cast<bool>(hit)));
        set(out.fraction, hit.fraction);
        set(out.exact_fraction, hit.exact_fraction);
        set_three(out.point, hit.point);
        set_three(out.position, hit.position);
        set_three(out.normal, hit.normal);
        set_three(out.barycentric, hit.barycentric);
        set(out.face, hit.face);
        set(out.triangle, hit.triangle);
        set(out.side, hit.side);
        set(out.feature, hit.feature);
        set(out.feature_index, hit.feature_index);
        set(out.at_start, flag(hit.at_start));
    }
};

struct AnyAnswers {
    std::uint8_t* out;

    void clear(std::size_t i) const { out[i] = 0; }
};

/// Calls `use` with the sink of what the caller gave.
template <class Scalar, class Use>
auto with_sink(const HitsOut<Scalar>& out, Use&& use) {
    if (const auto* optionals = std::get_if<std::span<std::optional<Hit<Scalar>>>>(&out))
        return use(OptionalHits<Scalar>{optionals->data()});
    if (const auto* plain = std::get_if<std::span<Hit<Scalar>>>(&out)) return use(PlainHits<Scalar>{plain->data()});
    return use(ArraysOfHits<Scalar>{*std::get_if<HitArrays<Scalar>>(&out)});
}

template <class Scalar>
[[nodiscard]] std::size_t size_of(const HitsOut<Scalar>& out) {
    if (const auto* optionals = std::get_if<std::span<std::optional<Hit<Scalar>>>>(&out)) return optionals->size();
    if (const auto* plain = std::get_if<std::span<Hit<Scalar>>>(&out)) return plain->size();
    return std::get_if<HitArrays<Scalar>>(&out)->count;
}

}  // namespace pierce::detail

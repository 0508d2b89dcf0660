// What a world's query wants of the hits in one of its meshes: as collectors.h, for the faces whose layers count.
#pragma once

#include <query/collectors.h>
#include <world/instances.h>

namespace pierce::detail {

/// The triangles that the wide kernels left of a way in all meshes, those of a mesh one after the other; if `complete`,
/// all that could stop a point on a way to near the hit (near.h).
struct WorldShortlist {
    struct Entry {
        std::uint32_t index;  ///< of the instance
        TriangleRef triangle;
    };

    void add(std::uint32_t index, TriangleRef triangle) {
        if (count == entries.size())
            complete = false;
        else
            entries[count++] = {index, triangle};
    }

    std::array<Entry, 64> entries;
    unsigned count = 0;
    bool complete = true;
};

/// Keeps the first hit of an instance, as long as it is not beyond what was found in others, but for those that
/// `passed(triangle)` says are known.
template <class Scalar, class Passed>
class FirstHere : public First<Scalar> {
  public:
    FirstHere(const Instance<Scalar>& instance, std::uint32_t mask, const Path& path, double limit,
              const Passed& passed, QueryCounters& counters)
        : First<Scalar>(*instance.scene, path, counters), filter_(instance, mask), limit_(limit), passed_(passed) {}

    [[nodiscard]] double limit() const { return std::min(First<Scalar>::limit(), limit_); }
    [[nodiscard]] bool wants(TriangleRef triangle) const { return filter_.counts(triangle); }
    void seen(TriangleRef) {}
    void add() {
        if (!passed_(this->room().triangle)) First<Scalar>::add();
    }

  private:
    FaceFilter<Scalar> filter_;
    double limit_;
    const Passed& passed_;
};

/// Stops at any hit of an instance, but for those that `passed(triangle)` says are known.
template <class Scalar, class Passed>
class AnyHere {
  public:
    AnyHere(const Instance<Scalar>& instance, std::uint32_t mask, const Passed& passed)
        : filter_(instance, mask), passed_(passed) {}

    [[nodiscard]] double limit() const { return found_ ? -1 : 1; }
    [[nodiscard]] bool wants(TriangleRef triangle) const { return !found_ && filter_.counts(triangle); }
    [[nodiscard]] Candidate& room() { return candidate_; }
    void seen(TriangleRef) {}
    void add() { found_ = !passed_(candidate_.triangle); }
    [[nodiscard]] bool found() const { return found_; }
    [[nodiscard]] const Candidate& candidate() const { return candidate_; }

  private:
    FaceFilter<Scalar> filter_;
    const Passed& passed_;
    Candidate candidate_;
    bool found_ = false;
};

/// Hands each hit of an instance to `add(candidate)`.
template <class Scalar, class Add>
class EachHere {
  public:
    EachHere(const Instance<Scalar>& instance, std::uint32_t mask, const Add& add)
        : filter_(instance, mask), add_(add) {}

    [[nodiscard]] double limit() const { return 1; }
    [[nodiscard]] bool wants(TriangleRef triangle) const { return filter_.counts(triangle); }
    [[nodiscard]] Candidate& room() { return candidate_; }
    void seen(TriangleRef) {}
    void add() { add_(candidate_); }

  private:
    FaceFilter<Scalar> filter_;
    const Add& add_;
    Candidate candidate_;
};

}  // namespace pierce::detail

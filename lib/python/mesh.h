// A mesh as Python holds it: of either scalar type, and asked by many threads or changed by one.
#pragma once

#include <memory>
#include <stdexcept>
#include <utility>
#include <variant>

#include <pierce/pierce.h>
#include <pybind11/pybind11.h>
#include <python/arrays.h>

namespace pierce::python {

namespace py = pybind11;

/// Who is at work on something, counted under the interpreter's lock.
class Use {
  public:
    /// Many may ask at a time.
    class Asking {
      public:
        explicit Asking(Use& use) : use_(use) {
            if (use_.changing_) throw std::runtime_error("another thread is changing this just now");
            ++use_.asking_;
        }
        ~Asking() { --use_.asking_; }
        Asking(const Asking&) = delete;
        Asking& operator=(const Asking&) = delete;

      private:
        Use& use_;
    };
    /// One changes, and nobody asks meanwhile.
    class Changing {
      public:
        explicit Changing(Use& use) : use_(use) {
            if (use_.changing_ || use_.asking_ != 0)
                throw std::runtime_error("this can't be changed while a query, or another change, is under way");
            use_.changing_ = true;
        }
        ~Changing() { use_.changing_ = false; }
        Changing(const Changing&) = delete;
        Changing& operator=(const Changing&) = delete;

      private:
        Use& use_;
    };

  private:
    int asking_ = 0;
    bool changing_ = false;
};

class Mesh {
  public:
    template <class Scalar>
    using Kept = std::shared_ptr<const CollisionMesh<Scalar>>;

    /// One that may change.
    template <class Scalar>
    Mesh(CollisionMesh<Scalar>&& mesh, const FaceCount& faces)
        : kept_(Kept<Scalar>(std::make_shared<CollisionMesh<Scalar>>(std::move(mesh)))),
          flags_(faces),
          changes_(true) {}
    /// One that belongs to a step, and stays as it is.
    template <class Scalar>
    Mesh(Kept<Scalar> mesh, const FaceCount& faces) : kept_(std::move(mesh)), flags_(faces) {}

    [[nodiscard]] bool is_double() const { return kept_.index() == 1; }
    /// What an array of one entry for each face is to have.
    [[nodiscard]] const FaceCount& flags() const { return flags_; }

    /// Calls `ask(const CollisionMesh<Scalar>&)`.
    template <class Ask>
    auto ask(Ask&& ask) const {
        const Use::Asking asking(use_);
        return std::visit([&](const auto& mesh) { return ask(*mesh); }, kept_);
    }
    /// Calls `change(CollisionMesh<Scalar>&)`.
    template <class Change>
    void change(Change&& change) {
        if (!changes_) throw std::runtime_error("the mesh of a step stays as it is");
        const Use::Changing changing(use_);
        std::visit([&]<class Scalar>(const Kept<Scalar>& mesh) { change(const_cast<CollisionMesh<Scalar>&>(*mesh)); },
                   kept_);
    }

  private:
    std::variant<Kept<float>, Kept<double>> kept_;
    FaceCount flags_;
    bool changes_ = false;
    mutable Use use_;
};

template <class Class>
struct ScalarOfClass;
template <template <class> class Class, class Scalar>
struct ScalarOfClass<Class<Scalar>> {
    using type = Scalar;
};
/// float of a `const CollisionMesh<float>&`, and so on.
template <class Class>
using ScalarOf = typename ScalarOfClass<std::remove_cvref_t<Class>>::type;

}  // namespace pierce::python

// One table of kernels for each Scalar.
#pragma once

namespace pierce::detail {

template <template <class> class Kernels>
struct PerScalar {
    Kernels<float> of_floats;
    Kernels<double> of_doubles;

    template <class Scalar>
    [[nodiscard]] const Kernels<Scalar>& of() const {
        if constexpr (sizeof(Scalar) == sizeof(float))
            return of_floats;
        else
            return of_doubles;
    }
};

}  // namespace pierce::detail

// Points that somebody else owns, wherever they lie in memory: what meshes are built from and batches are asked about.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstring>
#include <span>

#include <pierce/export.h>
#include <pierce/types.h>

namespace pierce {

namespace detail {

template <class Range, class Element>
concept SpanOf = std::convertible_to<const Range&, std::span<const Element>>;

/// Whether a matrix has points as columns that are one number after the other in memory.
template <class Matrix, class Scalar>
concept HasColumns = std::same_as<typename Matrix::Scalar, Scalar> &&(Matrix::Flags& Eigen::DirectAccessBit) != 0 &&
                     (Matrix::RowsAtCompileTime == 3 || Matrix::RowsAtCompileTime == Eigen::Dynamic) &&
                     Matrix::InnerStrideAtCompileTime == 1 && !Matrix::IsRowMajor;

}  // namespace detail

/// Throws std::invalid_argument for a matrix of so many rows, from within the library, as `throw_mesh_error` does.
[[noreturn]] PIERCE_EXPORT void throw_rows_error(std::ptrdiff_t rows);

/// `size()` points; a point is three numbers in a row, and from one point to the next is a fixed number of bytes, which
/// may be any, negative as well: a `std::vector<Vec3<Scalar>>`, the columns of an Eigen matrix with three rows (or of a
/// block or map of one), the vertex buffer of a game, an array of NumPy. A view in double takes floats too; one in
/// float refuses doubles, which it would have to round. Not owned, nothing is copied.
template <class Scalar>
class PointsView {
    static_assert(is_scalar_v<Scalar>, "pierce works in float or double");

  public:
    PointsView() = default;

    /// `stride`: bytes from one point's first number to the next one's. They need no alignment.
    PointsView(const Scalar* first, std::size_t size, std::ptrdiff_t stride = 3 * sizeof(Scalar))
        : first_(reinterpret_cast<const std::byte*>(first)), size_(size), stride_(stride) {}
    PointsView(const float* first, std::size_t size,
               std::ptrdiff_t stride = 3 * sizeof(float)) requires std::same_as<Scalar, double>
        : first_(reinterpret_cast<const std::byte*>(first)), size_(size), stride_(stride), widens_(true) {}

    /// A vector, an array or a span of points.
    template <detail::SpanOf<Vec3<Scalar>> Range>
    PointsView(const Range& points) : PointsView(first_of(std::span<const Vec3<Scalar>>(points)), std::size(points)) {}
    /// The same in float, for a view in double.
    template <detail::SpanOf<Vec3<float>> Range>
    requires std::same_as<Scalar, double> PointsView(const Range& points)
        : PointsView(first_of(std::span<const Vec3<float>>(points)), std::size(points)) {}

    /// The columns of a matrix. Throws std::invalid_argument where it has not three rows: one with three columns and a
    /// point in each row has to be transposed, or given by a pointer and a stride if it is row-major.
    template <class Matrix>
    requires detail::HasColumns<Matrix, Scalar> PointsView(const Eigen::MatrixBase<Matrix>& columns)
        : PointsView(columns.derived().data(), static_cast<std::size_t>(columns.cols()),
                     columns.derived().outerStride() * static_cast<std::ptrdiff_t>(sizeof(Scalar))) {
        if (columns.rows() != 3) throw_rows_error(columns.rows());
    }

    /// How many points there are.
    [[nodiscard]] std::size_t size() const { return size_; }
    /// Whether there are none.
    [[nodiscard]] bool empty() const { return size_ == 0; }
    /// Bytes from one point to the next.
    [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
    /// Where the first point is; null where it is a float of a view in double.
    [[nodiscard]] const Scalar* data() const { return widens_ ? nullptr : reinterpret_cast<const Scalar*>(first_); }
    /// Points `first` up to `first + count`, without that.
    [[nodiscard]] PointsView part(std::size_t first, std::size_t count) const {
        PointsView some = *this;
        some.first_ += static_cast<std::ptrdiff_t>(first) * stride_;
        some.size_ = count;
        return some;
    }
    /// A copy of point i, which must be below `size()`.
    [[nodiscard]] Vec3<Scalar> operator[](std::size_t i) const {
        return widens_ ? Vec3<Scalar>(load<float>(i).template cast<Scalar>()) : load<Scalar>(i);
    }

  private:
    template <class Number>
    static const Number* first_of(std::span<const Vec3<Number>> points) {
        static_assert(sizeof(Vec3<Number>) == 3 * sizeof(Number));
        return reinterpret_cast<const Number*>(points.data());
    }
    template <class Number>
    [[nodiscard]] Vec3<Number> load(std::size_t i) const {
        Number numbers[3];
        std::memcpy(numbers, first_ + static_cast<std::ptrdiff_t>(i) * stride_, sizeof numbers);
        return {numbers[0], numbers[1], numbers[2]};
    }

    const std::byte* first_ = nullptr;
    std::size_t size_ = 0;
    std::ptrdiff_t stride_ = 3 * sizeof(Scalar);
    bool widens_ = false;
};

}  // namespace pierce

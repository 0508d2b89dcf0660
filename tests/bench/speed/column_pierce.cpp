#include <functional>
#include <optional>

#include "broadphase.h"
#include "column.h"
#include "threads.h"

namespace pierce::bench {
namespace {

template <class Scalar>
class PierceColumn : public Column {
  public:
    PierceColumn(std::string_view name, SharedMesh<Scalar> mesh) : Column(name), mesh_(std::move(mesh)) {}

    void prepare(std::span<const Segment<float>> segments) override {
        segments_.clear();
        for (const Segment<float>& s : segments)
            segments_.push_back({s.from.template cast<Scalar>(), s.to.template cast<Scalar>()});
    }

  protected:
    [[nodiscard]] const CollisionMesh<Scalar>& mesh() const { return *mesh_; }
    [[nodiscard]] std::span<const Segment<Scalar>> segments() const { return segments_; }

  private:
    SharedMesh<Scalar> mesh_;
    std::vector<Segment<Scalar>> segments_;
};

template <class Scalar>
class First : public PierceColumn<Scalar> {
  public:
    First(std::string_view name, SharedMesh<Scalar> mesh, Sides sides)
        : PierceColumn<Scalar>(name, std::move(mesh)), options_{.sides = sides} {}

    std::size_t ask(std::size_t begin, std::size_t end) override {
        std::size_t hits = 0;
        for (std::size_t i = begin; i < end; ++i)
            hits += this->mesh().first_hit(this->segments()[i], options_).has_value() ? 1U : 0U;
        return hits;
    }
    Answer answer(std::size_t i) override {
        const auto hit = this->mesh().first_hit(this->segments()[i], options_);
        return hit ? Answer{true, double(hit->exact_fraction)} : Answer{};
    }

  private:
    QueryOptions options_;
};

template <class Scalar>
class Any : public PierceColumn<Scalar> {
  public:
    using PierceColumn<Scalar>::PierceColumn;
    std::size_t ask(std::size_t begin, std::size_t end) override {
        std::size_t hits = 0;
        for (std::size_t i = begin; i < end; ++i)
            hits += this->mesh().any_hit(this->segments()[i], {.sides = Sides::both}) ? 1U : 0U;
        return hits;
    }
};

template <class Scalar>
class FirstBatch : public PierceColumn<Scalar> {
  public:
    FirstBatch(std::string_view name, SharedMesh<Scalar> mesh, Sides sides, unsigned threads = 1)
        : PierceColumn<Scalar>(name, std::move(mesh)), threads_(threads) {
        options_.sides = sides;
        if (threads > 1) executor_ = std::ref(threads_);
    }

    void prepare(std::span<const Segment<float>> segments) override {
        PierceColumn<Scalar>::prepare(segments);
        out_.assign(segments.size(), std::nullopt);
    }
    std::size_t ask(std::size_t begin, std::size_t end) override {
        const std::size_t count = end - begin;
        return this->mesh().first_hits(this->segments().subspan(begin, count), std::span(out_).subspan(begin, count),
                                       options_, executor_);
    }

  private:
    std::vector<std::optional<Hit<Scalar>>> out_;
    Threads threads_;
    QueryOptions options_;
    Executor executor_;
};

template <class Scalar>
class AnyBatch : public PierceColumn<Scalar> {
  public:
    using PierceColumn<Scalar>::PierceColumn;
    void prepare(std::span<const Segment<float>> segments) override {
        PierceColumn<Scalar>::prepare(segments);
        out_.assign(segments.size(), 0);
    }
    std::size_t ask(std::size_t begin, std::size_t end) override {
        const std::size_t count = end - begin;
        return this->mesh().any_hits(this->segments().subspan(begin, count), std::span(out_).subspan(begin, count),
                                     {.sides = Sides::both});
    }

  private:
    std::vector<std::uint8_t> out_;
};

}  // namespace

template <>
void add_pierce_columns<float>(Columns& columns, const SharedMesh<float>& mesh) {
    columns.push_back(std::make_unique<First<float>>(column::pierce, mesh, Sides::both));
    columns.push_back(pierce_batch_column(column::pierce_batch, mesh, 1));
    columns.push_back(std::make_unique<Any<float>>(column::pierce_any, mesh));
    columns.push_back(std::make_unique<AnyBatch<float>>(column::pierce_any_batch, mesh));
    columns.push_back(std::make_unique<First<float>>(column::fronts, mesh, Sides::front));
    columns.push_back(std::make_unique<FirstBatch<float>>(column::fronts_batch, mesh, Sides::front));
}

template <>
void add_pierce_columns<double>(Columns& columns, const SharedMesh<double>& mesh) {
    columns.push_back(std::make_unique<First<double>>(column::pierce_double, mesh, Sides::both));
    columns.push_back(std::make_unique<FirstBatch<double>>(column::pierce_double_batch, mesh, Sides::both));
}

void add_grid_columns(Columns& columns, const MeshView<float>& mesh) {
    const auto built = std::make_shared<const CollisionMesh<float>>(mesh, grid_options());
    columns.push_back(std::make_unique<First<float>>(column::grid, built, Sides::both));
    columns.push_back(pierce_batch_column(column::grid_batch, built, 1));
}

std::unique_ptr<Column> pierce_batch_column(std::string_view name, const SharedMesh<float>& mesh, unsigned threads) {
    return std::make_unique<FirstBatch<float>>(name, mesh, Sides::both, threads);
}

}  // namespace pierce::bench

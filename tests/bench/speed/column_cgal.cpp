#include <algorithm>

#include "../cgal_tree.h"
#include "column.h"

namespace pierce::bench {
namespace {

class CgalColumn : public Column {
  public:
    CgalColumn(std::string_view name, std::shared_ptr<const CgalTree> tree) : Column(name), tree_(std::move(tree)) {}

    void prepare(std::span<const Segment<float>> segments) override {
        segments_.clear();
        for (const Segment<float>& s : segments)
            segments_.emplace_back(CgalTree::point(s.from.cast<double>()), CgalTree::point(s.to.cast<double>()));
    }

  protected:
    [[nodiscard]] const CgalTree& tree() const { return *tree_; }
    [[nodiscard]] const CgalTree::Kernel::Segment_3& segment(std::size_t i) const { return segments_[i]; }

  private:
    std::shared_ptr<const CgalTree> tree_;
    std::vector<CgalTree::Kernel::Segment_3> segments_;
};

class Any : public CgalColumn {
  public:
    using CgalColumn::CgalColumn;
    std::size_t ask(std::size_t begin, std::size_t end) override {
        std::size_t hits = 0;
        for (std::size_t i = begin; i < end; ++i) hits += tree().get().do_intersect(segment(i)) ? 1U : 0U;
        return hits;
    }
    /// By pierce's rule for both sides, so that both must say the same: the ends are on different sides of a triangle
    /// that the segment meets, where on its plane counts as in front.
    Answer answer(std::size_t i) override {
        std::vector<CgalTree::Triangles::const_iterator> met;
        tree().get().all_intersected_primitives(segment(i), std::back_inserter(met));
        return {.hit = std::any_of(met.begin(), met.end(), [&](const auto& t) {
                    const auto behind = [&](const CgalTree::Kernel::Point_3& p) {
                        return CGAL::orientation(t->vertex(0), t->vertex(1), t->vertex(2), p) == CGAL::NEGATIVE;
                    };
                    return behind(segment(i).source()) != behind(segment(i).target());
                })};
    }
};

class First : public CgalColumn {
  public:
    using CgalColumn::CgalColumn;
    std::size_t ask(std::size_t begin, std::size_t end) override {
        std::size_t hits = 0;
        for (std::size_t i = begin; i < end; ++i)
            hits += tree().nearest(segment(i), [](const CgalTree::Kernel::Triangle_3&) { return true; }).has_value()
                        ? 1U
                        : 0U;
        return hits;
    }
};

}  // namespace

void add_cgal_columns(Columns& columns, const MeshView<float>& mesh) {
    const auto tree = std::make_shared<const CgalTree>(mesh);
    columns.push_back(std::make_unique<Any>(column::cgal_any, tree));
    columns.push_back(std::make_unique<First>(column::cgal_first, tree));
}

}  // namespace pierce::bench

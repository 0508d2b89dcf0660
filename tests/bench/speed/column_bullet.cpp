#include "../bullet_shape.h"
#include "column.h"

namespace pierce::bench {
namespace {

/// Takes the nearest hit, as Bullet's own callbacks do: each later one has to be nearer than what is returned.
struct Nearest : btTriangleRaycastCallback {
    using btTriangleRaycastCallback::btTriangleRaycastCallback;
    btScalar reportHit(const btVector3&, btScalar fraction, int, int) override { return fraction; }
};

class BulletColumn : public Column {
  public:
    explicit BulletColumn(const MeshView<float>& mesh) : Column(column::bullet), shape_(mesh) {}

    void prepare(std::span<const Segment<float>> segments) override {
        ends_.clear();
        for (const Segment<float>& s : segments) ends_.push_back({to_bullet(s.from), to_bullet(s.to)});
    }
    std::size_t ask(std::size_t begin, std::size_t end) override {
        std::size_t hits = 0;
        for (std::size_t i = begin; i < end; ++i) {
            Nearest nearest(ends_[i][0], ends_[i][1]);
            shape_.get().performRaycast(&nearest, ends_[i][0], ends_[i][1]);
            hits += nearest.m_hitFraction < 1 ? 1U : 0U;
        }
        return hits;
    }

  private:
    static btVector3 to_bullet(const Vec3<float>& p) { return {p[0], p[1], p[2]}; }

    BulletShape shape_;
    std::vector<std::array<btVector3, 2>> ends_;
};

}  // namespace

void add_bullet_column(Columns& columns, const MeshView<float>& mesh) {
    columns.push_back(std::make_unique<BulletColumn>(mesh));
}

}  // namespace pierce::bench

// A hundred thousand drops fall on a mesh, bounce, slide and come to rest, and none gets inside:
//   rain [MESH]                          a window, with sliders
//   rain [MESH] --picture rain.png       no window: 600 steps, then a picture
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <vector>

#include <pierce/pierce.h>
#include <pierce/tbb.h>
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include "show/demo.h"
#include "show/panel.h"
#include "show/random.h"
#include "show/shapes.h"

namespace {

using Vec3 = Eigen::Vector3f;
using Move = pierce::Move<float>;
using pierce::MoveState;

constexpr auto k_colours =
    "Blue drops fall, green ones have met the mesh, yellow ones rest on it, red ones are wedged.";

class Rain : public show::Demo {
  public:
    Rain(pierce::TriangleSoup<float> soup, std::size_t count)
        : soup_(std::move(soup)),
          mesh_(soup_.view(), {.executor = pierce::tbb_executor()}),
          drops_(count),
          has_touched_(count) {
        for (const Vec3& position : soup_.positions) box_.extend(position);
        gravity_ = 2 * box_.diagonal().y();  // so that it takes a second to fall past the mesh
        // At first they are anywhere above the mesh, so that the rain is even from the start.
        for (std::size_t i = 0; i < count; ++i) {
            renew(i);
            drops_[i].position.y() += random_() * box_.diagonal().y();
        }
    }

    void step() override {
        // What a user of the library writes: velocities from forces, one call, and what became of the drops.
        std::vector<Vec3> velocities(drops_.size());
        for (std::size_t i = 0; i < drops_.size(); ++i) {
            Move& drop = drops_[i];
            if (drop.position.y() < box_.min().y() - 0.1f * box_.diagonal().y() || random_() < evaporation_) renew(i);
            velocities[i] = drop.velocity - Vec3(0, gravity_ * seconds_, 0);
        }
        const pierce::MoveOptions<float> options = {
            .response = {.restitution = restitution_, .friction = friction_, .rest_speed = 2 * gravity_ * seconds_}};
        const pierce::PointsView<float> positions(drops_.front().position.data(), drops_.size(), sizeof(Move));
        pierce::moves_and_bounce(mesh_, positions, velocities, seconds_, drops_, options, pierce::tbb_executor());
        for (std::size_t i = 0; i < drops_.size(); ++i)
            if (drops_[i].state != MoveState::free) has_touched_[i] = true;
        ++steps_;
    }

    /// How many drops are inside the mesh: none can be, if it is closed.
    [[nodiscard]] std::size_t leaked() const {
        std::vector<pierce::Location> locations(drops_.size());
        mesh_.locate_points({drops_.front().position.data(), drops_.size(), sizeof(Move)}, locations, nullptr,
                            pierce::tbb_executor());
        return static_cast<std::size_t>(std::count_if(locations.begin(), locations.end(), [](const auto& location) {
            return location.place == pierce::Place::inside;
        }));
    }

    [[nodiscard]] const pierce::CollisionMesh<float>& mesh() const override { return mesh_; }
    [[nodiscard]] const pierce::TriangleSoup<float>& soup() const override { return soup_; }
    [[nodiscard]] show::Paint paint() const override {
        return {.front = {0.5f, 0.47f, 0.42f}, .back = {0.6f, 0.2f, 0.2f}};
    }

    [[nodiscard]] std::vector<show::Dot> dots() const override {
        std::vector<show::Dot> dots;
        const double size = 0.6 * box_.diagonal().norm() / std::sqrt(static_cast<double>(drops_.size()));
        for (std::size_t i = 0; i < drops_.size(); ++i)
            dots.push_back({drops_[i].position.cast<double>(), colour_of(drops_[i].state, has_touched_[i]),
                            has_touched_[i] ? size : 0.5 * size});
        return dots;
    }

    void panel() override {
        show::slider("gravity", gravity_, 0, 10 * box_.diagonal().y());
        show::slider("restitution", restitution_, 0, 1);
        show::slider("friction", friction_, 0, 1);
        show::slider("evaporation", evaporation_, 0, 0.05f);
        show::text(summary() + k_colours);
    }

    [[nodiscard]] std::string summary() const override {
        std::size_t counts[5] = {};
        for (const Move& drop : drops_) ++counts[static_cast<std::size_t>(drop.state)];
        std::ostringstream text;
        text << drops_.size() << " drops: " << counts[0] << " free, " << counts[1] << " bouncing or sliding, "
             << counts[2] << " resting, " << counts[3] << " wedged\n"
             << leaked() << " inside the mesh after " << steps_ << " steps\n";
        return text.str();
    }

    [[nodiscard]] bool holds() const override { return leaked() == 0; }

  private:
    static show::Colour colour_of(MoveState state, bool has_touched) {
        if (state == MoveState::resting) return {1.0f, 0.6f, 0.1f};
        if (state == MoveState::wedged) return {1.0f, 0.1f, 0.1f};
        return has_touched ? show::Colour(0.1f, 0.75f, 0.5f) : show::Colour(0.2f, 0.4f, 0.8f);
    }

    void renew(std::size_t i) {
        const Vec3 at(random_(), 1.05f + 0.3f * random_(), random_());
        has_touched_[i] = false;
        drops_[i] = {.position = box_.min() + at.cwiseProduct(box_.diagonal()),
                     .velocity = Vec3::Zero(),
                     .travel = Vec3::Zero(),
                     .remainder = Vec3::Zero()};
    }

    pierce::TriangleSoup<float> soup_;
    pierce::CollisionMesh<float> mesh_;
    std::vector<Move> drops_;
    std::vector<bool> has_touched_;  // since it began to fall
    Eigen::AlignedBox3f box_;
    show::Random random_;
    float seconds_ = 1.0f / 60;
    float gravity_ = 0;
    float restitution_ = 0.4f;
    float friction_ = 0.3f;
    float evaporation_ = 0.002f;
    std::size_t steps_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
    show::DemoOptions options;
    std::filesystem::path mesh;
    std::size_t count = 100'000;
    CLI::App app("Drops fall on a mesh, bounce, slide and come to rest.", "rain");
    app.footer(k_colours);
    app.add_option("MESH", mesh, "A closed mesh: OBJ, OFF, PLY or STL; else a bumpy sphere is made")->option_text(" ");
    app.add_option("--drops", count, "How many drops (100000)")->check(CLI::Range(1, 100'000'000))->option_text("N");
    show::add_demo_options(app, options);
    CLI11_PARSE(app, argc, argv);
    try {
        auto rain = std::make_unique<Rain>(show::mesh_or(mesh, show::bumpy_sphere(80)), count);
        return show::run(std::move(rain), "rain", options);
    } catch (const std::exception& error) {
        std::cerr << "rain: " << error.what() << '\n';
        return 2;
    }
}

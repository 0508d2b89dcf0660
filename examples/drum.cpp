// A turning drum with paddles, full of grains: the mesh moves, and carries them up until they slide off.
//   drum [--grains 5000]                 a window, with sliders
//   drum --picture drum.png              no window: 600 steps, then a picture
#include <algorithm>
#include <iostream>
#include <memory>
#include <numbers>
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

constexpr auto k_colours = "Blue grains fly, yellow ones touch the drum.";

class Drum : public show::Demo {
  public:
    explicit Drum(std::size_t count) : soup_(show::paddle_drum()), mesh_(soup_.view()), grains_(count) {
        for (Move& grain : grains_) {  // in the middle, where the paddles do not reach
            grain.position = {0.8f * random_() - 0.4f, 0.8f * random_() - 0.4f, 0.9f * random_() - 0.45f};
            grain.velocity = {0, 0, 0};
        }
        rest_ = soup_.positions;
    }

    void step() override {
        angle_ += 2 * std::numbers::pi_v<float> * turns_ * k_seconds;
        const pierce::Pose<double> pose = {
            Eigen::AngleAxisd(static_cast<double>(angle_), Eigen::Vector3d::UnitZ()).toRotationMatrix(), {0, 0, 0}};
        // The mesh first: where it goes in this step. Then the grains, against the mesh on its way.
        mesh_.begin_step(pose, pierce::tbb_executor());
        std::vector<Vec3> velocities;
        for (const Move& grain : grains_) {  // a draught keeps them apart: they don't know of one another
            const Vec3 draught(random_() - 0.5f, random_() - 0.5f, random_() - 0.5f);
            velocities.push_back(grain.velocity - Vec3(0, k_gravity * k_seconds, 0) + 0.4f * draught);
        }
        const pierce::MoveOptions<float> options = {
            .response = {.restitution = restitution_, .friction = friction_, .rest_speed = 2 * k_gravity * k_seconds}};
        const pierce::PointsView<float> positions(grains_.front().position.data(), grains_.size(), sizeof(Move));
        pierce::moves_and_bounce(mesh_.step(), positions, velocities, k_seconds, grains_, options,
                                 pierce::tbb_executor());
        for (std::size_t i = 0; i < rest_.size(); ++i)
            soup_.positions[i] = (pose.rotation * rest_[i].cast<double>()).cast<float>();
        shown_ = mesh_.step();
        ++steps_;
    }

    /// How many grains are outside of the drum, exactly. Its faces look inwards: the winding number is -1 inside.
    [[nodiscard]] std::size_t leaked() const {
        return static_cast<std::size_t>(std::ranges::count_if(grains_, [&](const Move& grain) {
            return mesh_.step().after().locate(grain.position).place == pierce::Place::outside;
        }));
    }

    [[nodiscard]] const pierce::CollisionMesh<float>& mesh() const override { return shown_.after(); }
    [[nodiscard]] const pierce::TriangleSoup<float>& soup() const override { return soup_; }
    [[nodiscard]] bool mesh_changes() const override { return true; }
    /// One looks in through the wall that is turned this way.
    [[nodiscard]] show::Paint paint() const override {
        return {.front = {0.4f, 0.42f, 0.46f}, .back = {0.3f, 0.3f, 0.3f}, .sides = pierce::Sides::front};
    }
    [[nodiscard]] std::vector<show::Dot> dots() const override {
        std::vector<show::Dot> dots;
        for (const Move& grain : grains_)
            dots.push_back(
                {grain.position.cast<double>(),
                 grain.state == MoveState::free ? show::Colour(0.25f, 0.5f, 0.9f) : show::Colour(0.9f, 0.6f, 0.2f),
                 0.008});
        return dots;
    }
    void panel() override {
        show::slider("turns a second", turns_, -2, 2);
        show::slider("restitution", restitution_, 0, 1);
        show::slider("friction", friction_, 0, 2);
        show::text(summary() + k_colours);
    }
    [[nodiscard]] std::string summary() const override {
        const auto carried =
            std::ranges::count_if(grains_, [](const Move& grain) { return grain.state == MoveState::resting; });
        std::ostringstream text;
        text << grains_.size() << " grains, " << carried << " of them at rest on the wall that carries them\n"
             << leaked() << " outside of the drum after " << steps_ << " steps\n";
        return text.str();
    }
    [[nodiscard]] bool holds() const override { return leaked() == 0; }

  private:
    static constexpr float k_seconds = 1.0f / 120;
    static constexpr float k_gravity = 9.8f;

    pierce::TriangleSoup<float> soup_;
    pierce::DeformingMesh<float> mesh_;
    pierce::DeformationStep<float> shown_ = mesh_.step();
    std::vector<Vec3> rest_;
    std::vector<Move> grains_;
    show::Random random_;
    float angle_ = 0, turns_ = 0.3f, restitution_ = 0.6f, friction_ = 0.5f;
    std::size_t steps_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
    show::DemoOptions options;
    options.view.azimuth = 15;
    std::size_t count = 5000;
    CLI::App app("A turning drum with paddles, full of grains.", "drum");
    app.footer(k_colours);
    app.add_option("--grains", count, "How many grains (5000)")->check(CLI::Range(1, 10'000'000))->option_text("N");
    show::add_demo_options(app, options);
    CLI11_PARSE(app, argc, argv);
    try {
        return show::run(std::make_unique<Drum>(count), "drum", options);
    } catch (const std::exception& error) {
        std::cerr << "drum: " << error.what() << '\n';
        return 2;
    }
}

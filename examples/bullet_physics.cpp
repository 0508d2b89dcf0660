// pierce inside Bullet: three cars drive over a terrain, one with Bullet's own rays and two with pierce's, and rays are
// cast at the terrain's seams by both:
//   bullet_physics                       a window
//   bullet_physics --no-window           figures only
//   bullet_physics --picture drive.png   and a picture of the drive
#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <vector>

#include <CLI/CLI.hpp>

#include "bullet_physics/adapters.h"
#include "bullet_physics/car.h"
#include "bullet_physics/rays.h"
#include "bullet_physics/terrain.h"
#include "show/demo.h"
#include "show/panel.h"

namespace {

using namespace bullet_physics;

constexpr auto k_colours =
    "Red: a ray that Bullet answers wrongly.\n"
    "Ways, one above the other: orange on Bullet's rays, blue and cyan on pierce's.";

class Drive : public show::Demo {
  public:
    Drive(std::size_t rays, double tolerance) : near_(0), far_(4096), tolerance_(tolerance) {
        near_rays_ = cast_rays(near_, rays);
        far_rays_ = cast_rays(far_, rays);
    }

    void step() override {
        constexpr float k_seconds = 1.0f / 60;
        for (std::size_t k = 0; k < cars_.size(); ++k) {
            cars_[k]->step(k_seconds);
            tracks_[k].push_back(to_pierce(cars_[k]->position()).cast<double>());
        }
        for (const Caster caster : {raycaster, shape})
            furthest_[caster] = std::max(furthest_[caster], (tracks_[caster].back() - tracks_[bullet].back()).norm());
        wheels_down_ += cars_[raycaster]->wheels_on_the_ground();
    }

    /// The longest distance between a car of pierce's and Bullet's.
    [[nodiscard]] double furthest() const { return std::max(furthest_[raycaster], furthest_[shape]); }
    [[nodiscard]] bool holds() const override {
        return pierce_errors(near_rays_) + pierce_errors(far_rays_) == 0 && furthest() <= tolerance_;
    }

    [[nodiscard]] const pierce::CollisionMesh<float>& mesh() const override { return near_.mesh(); }
    [[nodiscard]] const pierce::TriangleSoup<float>& soup() const override { return near_.soup(); }
    [[nodiscard]] show::Paint paint() const override {
        return {.front = {0.32f, 0.38f, 0.22f}, .back = {0.3f, 0.2f, 0.15f}};
    }
    /// Wheels, larger than they are, and red dots where Bullet's answers are wrong.
    [[nodiscard]] std::vector<show::Dot> dots() const override {
        std::vector<show::Dot> dots;
        for (int wheel = 0; wheel < 4; ++wheel) {
            const Vec3 place = to_pierce(cars_[raycaster]->wheel(wheel));
            dots.push_back({place.cast<double>(), {0.1f, 0.1f, 0.9f}, 1});
        }
        for (const Vec3& place : near_rays_.wrong) dots.push_back({place.cast<double>(), {1, 0.05f, 0.05f}, 0.6});
        return dots;
    }
    /// The ways that the cars took: Bullet's with a stroke of pierce's a little above, so that both are seen.
    [[nodiscard]] std::vector<show::Line> lines() const override {
        std::vector<show::Line> lines;
        const std::array<show::Colour, caster_count> colours = {{{1, 0.5f, 0.1f}, {0.2f, 0.4f, 1}, {0.2f, 0.9f, 0.9f}}};
        for (std::size_t k = 0; k < cars_.size(); ++k) {
            const show::Point lift(0, 0.5 + 0.8 * static_cast<double>(k), 0);
            for (std::size_t i = 1; i < tracks_[k].size(); ++i)
                lines.push_back({tracks_[k][i - 1] + lift, tracks_[k][i] + lift, colours[k], 2});
        }
        return lines;
    }
    void panel() override {
        std::ostringstream text;
        text << std::setprecision(3) << "furthest from Bullet's car: " << furthest() << " m\n" << k_colours;
        show::text(text.str());
    }
    [[nodiscard]] std::string summary() const override {
        std::ostringstream text;
        text << soup().triangles.size() << " triangles around the origin\n";
        print(text, near_rays_);
        text << "\nthe same around (4096, 0, 4096)\n";
        print(text, far_rays_);
        double length = 0;
        const auto& track = tracks_[raycaster];
        for (std::size_t i = 1; i < track.size(); ++i) length += (track[i] - track[i - 1]).norm();
        text << "\nthe car drives " << std::fixed << std::setprecision(1) << length << " m with "
             << static_cast<double>(wheels_down_) / static_cast<double>(std::max<std::size_t>(track.size(), 1))
             << " wheels on the ground\nfurthest from Bullet's car: pierce " << std::scientific << furthest_[raycaster]
             << " m, as a shape " << furthest_[shape] << " m (tolerance " << tolerance_ << " m)\n";
        return text.str();
    }

  private:
    /// Each has a world of its own, and all start alike.
    std::unique_ptr<Car> car(btCollisionShape& ground, const Car::MakeRaycaster& make) {
        return std::make_unique<Car>(ground, to_bullet(near_.corner(34, 64) + Vec3(0, 1.2f, 0)), make);
    }
    static std::unique_ptr<btVehicleRaycaster> bullets_own(World& world) {
        return std::make_unique<btDefaultVehicleRaycaster>(&world.dynamics);
    }

    Terrain near_, far_;
    double tolerance_;
    Rays near_rays_, far_rays_;
    btBvhTriangleMeshShape bullets_shape_{&near_.triangles(), true};
    PierceShape pierce_shape_{near_.mesh(), &near_.triangles()};
    std::array<std::unique_ptr<Car>, caster_count> cars_ = {
        car(bullets_shape_, bullets_own),
        car(bullets_shape_,
            [this](World& world) { return std::make_unique<PierceRaycaster>(near_.mesh(), world.ground); }),
        car(pierce_shape_, bullets_own)};
    std::array<std::vector<show::Point>, caster_count> tracks_;
    std::array<double, caster_count> furthest_ = {};
    int wheels_down_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
    show::DemoOptions options;
    options.view.elevation = 35;
    options.view.zoom = 1.4;
    options.steps = 1200;
    std::size_t rays = 20'000;
    double tolerance = 0.01;
    CLI::App app(
        "Cars drive in a Bullet world, one on Bullet's rays and two on pierce's; rays are cast at a terrain's seams by "
        "both.",
        "bullet_physics");
    app.footer(k_colours);
    app.add_option("--rays", rays, "How many of each kind (20000)")->check(CLI::Range(1, 10'000'000))->option_text("N");
    app.add_option("--tolerance", tolerance, "How far from Bullet's car pierce's may get, in meters (0.01)")
        ->check(show::finite)
        ->check(CLI::Range(0.0, 100.0))
        ->option_text("METERS");
    show::add_demo_options(app, options);
    CLI11_PARSE(app, argc, argv);
    try {
        return show::run(std::make_unique<Drive>(rays, tolerance), "bullet_physics", options);
    } catch (const std::exception& error) {
        std::cerr << "bullet_physics: " << error.what() << '\n';
        return 2;
    }
}

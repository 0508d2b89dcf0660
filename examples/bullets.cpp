// Bullets ricochet in a hall, go through what is thin, and when they are spent fall down and roll. The same bullets fly
// in a world of plain floats as well, with the usual test of a segment and a triangle; both count how many of theirs
// are where none can be.
//   bullets                              a window, with sliders, and a button that shows the other world
//   bullets --no-window                  600 steps, and the counters
//   bullets --picture bullets.png        the same with a picture
#include <array>
#include <iostream>
#include <memory>
#include <sstream>
#include <vector>

#include <pierce/pierce.h>
#include <pierce/tbb.h>
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include "bullets/plain_floats.h"
#include "show/demo.h"
#include "show/panel.h"
#include "show/random.h"
#include "show/shapes.h"

namespace {

using bullets::Bullet;
using bullets::Vec3;

/// What a bullet does at a wall: it goes through what is at most this thick, if it comes steeply enough.
constexpr float k_penetrated = 0.5f;
constexpr float k_steep = 0.7f;  // cosine of the angle to the normal
constexpr float k_restitution = bullets::k_restitution;
constexpr float k_spent = 30;  // meters a second: slower ones go through nothing

/// Moves a bullet by what is left of the step, through any number of walls. No skin, no epsilon.
void fly(const pierce::CollisionMesh<float>& mesh, Bullet& bullet, float seconds) {
    for (int k = 0; k < 16 && seconds > 0; ++k) {
        const Vec3 target = bullet.position + seconds * bullet.velocity;
        const auto hit = mesh.sweep({bullet.position, target});
        if (!hit) {
            bullet.position = target;
            return;
        }
        seconds *= 1 - hit->fraction;
        bullet.position = hit->point;
        const float speed = bullet.velocity.norm();
        const Vec3 direction = bullet.velocity / speed;
        if (-direction.dot(hit->normal.vec()) > k_steep) {
            // How thick is it? The first two places where a way through it meets the surface.
            const pierce::Segment<float> through = {bullet.position, bullet.position + 2 * k_penetrated * direction};
            std::array<pierce::Passage<float>, 2> passages;
            const bool has_both = mesh.passages(through, passages, {.count_all = false}) == 2;
            if (has_both && passages[1].kind == pierce::PassageKind::leaving &&
                (passages[1].position - passages[0].position).norm() < k_penetrated) {
                // Behind it: the place where a bullet from the other side would be stopped.
                const auto back = mesh.first_hit({through.to, passages[0].position.vec()});
                if (back && back->face == passages[1].face) {
                    bullet.position = back->point;
                    bullet.velocity *= 0.8f;
                    ++bullet.walls;
                    continue;
                }
            }
        }
        bullet.velocity = pierce::bounce(bullet.velocity, hit->normal.vec(), k_restitution);
    }
}

/// One that is spent bounces, slides and comes to rest: all of it is in the library.
void roll(const pierce::CollisionMesh<float>& mesh, Bullet& bullet, float seconds) {
    const auto move =
        pierce::move_and_bounce(mesh, bullet.position, bullet.velocity, seconds,
                                {.response = {.restitution = k_restitution, .rest_speed = bullets::k_rest_speed}});
    bullet.position = move.position;
    bullet.velocity = move.velocity;
}

constexpr auto k_colours = "Orange bullets have gone through something, yellow ones have not; red: where one got out.";

class Bullets : public show::Demo {
  public:
    Bullets(std::size_t count, float offset, float skin)
        : frame_(frame_at(offset)), soup_(show::hall(1, frame_)), mesh_(soup_.view()), plain_(soup_), skin_(skin) {
        while (ours_.size() < count) {
            const Vec3 position = place(40 * random_(), 12 * random_(), 40 * random_());
            if (is_in_room(position)) ours_.push_back({position, shot(), 0});
        }
        theirs_ = ours_;
    }

    void step() override {
        pierce::tbb_executor()(ours_.size() / k_part + 1, [this](std::size_t part) {
            for (std::size_t i = k_part * part; i < std::min(k_part * (part + 1), ours_.size()); ++i) {
                for (Bullet* bullet : {&ours_[i], &theirs_[i]}) bullet->velocity.y() -= bullets::k_gravity * k_seconds;
                const bool is_spent = ours_[i].velocity.norm() < k_spent;
                is_spent ? roll(mesh_, ours_[i], k_seconds) : fly(mesh_, ours_[i], k_seconds);
                plain_.fly(theirs_[i], k_seconds, skin_);
            }
        });
        for (std::size_t i = 0; i < ours_.size(); ++i) {
            // Once in ten seconds it is shot again from where it lies, in each of the worlds.
            if ((steps_ + i) % 600 == 0) ours_[i].velocity = theirs_[i].velocity = shot();
            count_leak(ours_[i], our_leaks_, i);
            count_leak(theirs_[i], their_leaks_, i);
        }
        ++steps_;
    }

    [[nodiscard]] const pierce::CollisionMesh<float>& mesh() const override { return mesh_; }
    [[nodiscard]] const pierce::TriangleSoup<float>& soup() const override { return soup_; }
    /// One looks into the hall through its walls.
    [[nodiscard]] show::Paint paint() const override {
        return {.front = {0.45f, 0.45f, 0.5f}, .back = {0.3f, 0.2f, 0.2f}, .sides = pierce::Sides::front};
    }
    [[nodiscard]] std::vector<show::Dot> dots() const override {
        std::vector<show::Dot> dots;
        for (const Bullet& bullet : shows_plain_ ? theirs_ : ours_)
            dots.push_back({bullet.position.cast<double>(),
                            bullet.walls > 0 ? show::Colour(1, 0.5f, 0.1f) : show::Colour(1, 0.9f, 0.3f), 0.12});
        for (const Vec3& leak : shows_plain_ ? leaks_ : std::vector<Vec3>())
            dots.push_back({leak.cast<double>(), show::Colour(1, 0, 0), 0.2});
        return dots;
    }
    [[nodiscard]] std::vector<show::Line> lines() const override {
        std::vector<show::Line> lines;
        for (const Bullet& bullet : shows_plain_ ? theirs_ : ours_)
            lines.push_back({bullet.position.cast<double>(),
                             (bullet.position - 0.01f * bullet.velocity).cast<double>(),
                             {1, 0.7f, 0.3f},
                             1});
        return lines;
    }
    void panel() override {
        show::check_box("show the world of plain floats", shows_plain_);
        show::slider("its skin, a distance kept from walls", skin_, 0, 0.1f);
        show::text(summary() + k_colours);
    }
    [[nodiscard]] std::string summary() const override {
        std::ostringstream text;
        text << ours_.size() << " bullets, " << steps_ << " steps, lower corner of the hall at "
             << frame_.translation().x() << '\n'
             << "leaked, pierce: " << our_leaks_ << '\n'
             << "leaked, plain floats with a skin of " << skin_ << ": " << their_leaks_ << '\n';
        return text.str();
    }

    [[nodiscard]] bool holds() const override { return our_leaks_ == 0; }

  private:
    static constexpr std::size_t k_part = 16;
    static constexpr float k_seconds = 1.0f / 60;

    /// Exactly, also for the other world: where the winding number is not 0. What lies on a wall has not gone through.
    [[nodiscard]] bool is_in_room(const Vec3& point) const {
        return mesh_.locate(point).place != pierce::Place::outside;
    }

    void count_leak(Bullet& bullet, std::size_t& leaks, std::size_t i) {
        if (is_in_room(bullet.position)) return;
        ++leaks;
        if (leaks_.size() < 1000) leaks_.push_back(bullet.position);
        // Back to where there is room: into the middle of the square of its number, under the things.
        bullet.position = place(5 * static_cast<float>(i % 8) + 2.5f, 0.25f, 5 * static_cast<float>(i / 8 % 8) + 2.5f);
    }
    /// A hall that stands a little askew, as most of what is modelled does: no wall's plane is at a round number.
    static Eigen::Isometry3d frame_at(float offset) {
        const Eigen::AngleAxisd slope(0.03, Eigen::Vector3d(0.6, 0, 0.8)), turn(0.4, Eigen::Vector3d::UnitY());
        return Eigen::Translation3d(Eigen::Vector3d::Constant(static_cast<double>(offset))) * slope * turn;
    }
    [[nodiscard]] Vec3 place(float x, float y, float z) const {
        return (frame_ * Eigen::Vector3f(x, y, z).cast<double>()).cast<float>();
    }
    Vec3 shot() {
        const Vec3 direction(2 * random_() - 1, random_() - 0.5f, 2 * random_() - 1);
        return 200 * (direction + Vec3(0, 0, 1e-3f)).normalized();
    }

    Eigen::Isometry3d frame_;
    pierce::TriangleSoup<float> soup_;
    pierce::CollisionMesh<float> mesh_;
    bullets::PlainFloats plain_;
    std::vector<Bullet> ours_, theirs_;
    std::vector<Vec3> leaks_;
    show::Random random_;
    std::size_t our_leaks_ = 0, their_leaks_ = 0, steps_ = 0;
    bool shows_plain_ = false;
    float skin_;
};

}  // namespace

int main(int argc, char** argv) {
    show::DemoOptions options;
    options.view.elevation = 35;
    std::size_t count = 500;
    float offset = 1000, skin = 0;
    CLI::App app("Bullets ricochet in a hall: in pierce's world, and in one of plain floats. Which keeps its bullets?",
                 "bullets");
    app.footer(k_colours);
    app.add_option("--bullets", count, "How many bullets (500)")->check(CLI::Range(1, 1'000'000))->option_text("N");
    app.add_option("--skin", skin, "How far plain floats keep from what they hit, in meters, up to 1 (0)")
        ->check(show::finite)
        ->check(CLI::Range(0.0, 1.0))
        ->option_text("METERS");
    app.add_option("--offset", offset, "X, y and z of the hall's lower corner, in meters, up to 100000 (1000)")
        ->check(show::finite)
        ->check(CLI::Range(-1e5, 1e5))
        ->option_text("METERS");
    show::add_demo_options(app, options);
    CLI11_PARSE(app, argc, argv);
    try {
        return show::run(std::make_unique<Bullets>(count, offset, skin), "bullets", options);
    } catch (const std::exception& error) {
        std::cerr << "bullets: " << error.what() << '\n';
        return 2;
    }
}

// A ball walks through a courtyard: over a floor of many triangles, up a ramp and along walls, and no seam holds it up.
//   character                            a window: the way so far, and a slider for the direction
//   character --picture character.png    no window: 900 steps of a walk in circles
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>
#include <vector>

#include <pierce/pierce.h>
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include "show/demo.h"
#include "show/panel.h"
#include "show/shapes.h"

namespace {

using Vec3 = Eigen::Vector3f;

class Character : public show::Demo {
  public:
    Character() : soup_(show::courtyard()), mesh_(soup_.view()) {}

    void step() override {
        if (walks_by_itself_) heading_ += 0.004f;
        const bool is_on_flat_floor = nothing_else_is_near();
        // It walks as it wants, and falls as it must.
        const Vec3 wish = k_speed * Vec3(std::cos(heading_), 0, std::sin(heading_));
        Vec3 velocity(wish.x(), velocity_.y() - k_gravity * k_seconds, wish.z());
        const auto move = pierce::move_and_slide(mesh_, position_, velocity, k_seconds, {.radius = k_radius});
        position_ = move.position;
        velocity_ = move.velocity;
        contacts_ = move.contacts;
        way_.push_back(position_);
        // There each step should be as long as the wish, however many triangles are under it.
        if (is_on_flat_floor) {
            flat_way_ += static_cast<double>(std::hypot(move.travel.x(), move.travel.z()));
            wished_ += static_cast<double>(k_speed * k_seconds);
            ++flat_steps_;
        }
        ++steps_;
    }

    /// Whether the ball overlaps anything, exactly.
    [[nodiscard]] bool overlaps() const {
        std::vector<pierce::SphereHit<float>> contacts(8);
        const std::size_t count = std::min(mesh_.sphere_contacts(position_, k_radius, contacts), contacts.size());
        return std::any_of(contacts.begin(), contacts.begin() + static_cast<std::ptrdiff_t>(count),
                           [](const auto& contact) { return contact.overlap > 0; });
    }
    [[nodiscard]] double kept() const { return wished_ > 0 ? flat_way_ / wished_ : 1; }
    [[nodiscard]] bool holds() const override { return !overlaps() && kept() >= 0.999; }

    [[nodiscard]] const pierce::CollisionMesh<float>& mesh() const override { return mesh_; }
    [[nodiscard]] const pierce::TriangleSoup<float>& soup() const override { return soup_; }
    [[nodiscard]] show::Paint paint() const override {
        return {.front = {0.45f, 0.47f, 0.42f}, .back = {0.3f, 0.2f, 0.2f}, .sides = pierce::Sides::front};
    }
    [[nodiscard]] std::vector<show::Dot> dots() const override {
        return {{position_.cast<double>(), {0.9f, 0.35f, 0.15f}, static_cast<double>(k_radius)}};
    }
    [[nodiscard]] std::vector<show::Line> lines() const override {
        std::vector<show::Line> lines;
        for (std::size_t i = 1; i < way_.size(); ++i)
            lines.push_back({way_[i - 1].cast<double>(), way_[i].cast<double>(), {1, 0.8f, 0.2f}});
        return lines;
    }
    void panel() override {
        show::check_box("walks by itself", walks_by_itself_);
        show::slider("heading", heading_, -3.15f, 12);
        show::text(summary());
    }
    [[nodiscard]] std::string summary() const override {
        std::ostringstream text;
        text << steps_ << " steps, " << contacts_ << " contacts in the last one, "
             << (overlaps() ? "the ball overlaps the mesh" : "no overlap") << "\nspeed kept in " << flat_steps_
             << " steps on the flat floor: " << 100 * kept() << " %\n";
        return text.str();
    }

  private:
    static constexpr float k_seconds = 1.0f / 60;
    static constexpr float k_gravity = 9.8f;
    static constexpr float k_speed = 4;
    static constexpr float k_radius = 0.4f;

    /// Whether the ball meets nothing in a step but the floor: it is not the ball's answer that says so.
    [[nodiscard]] bool nothing_else_is_near() const {
        std::vector<pierce::SphereHit<float>> contacts(8);
        const std::size_t count = mesh_.sphere_contacts(position_, k_radius + 2 * k_speed * k_seconds, contacts);
        return count == 1 && contacts.front().normal.y() > 0.999f;
    }

    pierce::TriangleSoup<float> soup_;
    pierce::CollisionMesh<float> mesh_;
    Vec3 position_ = {8, 1, 8};
    Vec3 velocity_ = Vec3::Zero();
    std::vector<Vec3> way_;
    double flat_way_ = 0, wished_ = 0;
    std::size_t contacts_ = 0, steps_ = 0, flat_steps_ = 0;
    float heading_ = 0;
    bool walks_by_itself_ = true;
};

}  // namespace

int main(int argc, char** argv) {
    show::DemoOptions options;
    options.steps = 900;
    options.view.elevation = 40;
    CLI::App app(
        "A ball walks through a courtyard of many triangles, up a ramp and along walls, and catches on no edge.",
        "character");
    show::add_demo_options(app, options);
    CLI11_PARSE(app, argc, argv);
    try {
        return show::run(std::make_unique<Character>(), "character", options);
    } catch (const std::exception& error) {
        std::cerr << "character: " << error.what() << '\n';
        return 2;
    }
}

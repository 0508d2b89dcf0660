// The experiments of `trust`: each says what is asked, prints a table, and finds fault with pierce if it can.
#pragma once

#include <cstddef>
#include <iostream>
#include <string>

#include "peers.h"

namespace pierce::bench {

/// How much is measured, and what pierce got wrong: anything at all makes the program fail.
class Run {
  public:
    explicit Run(bool quick) : quick_(quick) {}

    [[nodiscard]] std::size_t many(std::size_t count) const { return quick_ ? count / 10 : count; }

    void must(bool holds, const Library& library, const std::string& promise, const Point& from, const Point& to) {
        if (holds || !library.is_pierce || ++failures_ > 10) return;
        std::cerr << std::hexfloat << library.name << ": " << promise << ": " << from.transpose() << " -> "
                  << to.transpose() << std::defaultfloat << std::endl;
    }
    [[nodiscard]] std::size_t failures() const { return failures_; }

  private:
    bool quick_;
    std::size_t failures_ = 0;
};

void seams(Run& run);
void repeated_steps(Run& run);
void scales(Run& run);
void ends_on_the_plane(Run& run);
void collide_and_slide(Run& run);
void lost_particles(Run& run);

}  // namespace pierce::bench

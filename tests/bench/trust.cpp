// Where do segments and particles get through a closed mesh that should not? pierce and its peers, side by side.
//   trust [--quick]
// Prints Markdown. Ends with status 1 if pierce breaks a promise anywhere, else 0.
#include <chrono>
#include <exception>
#include <iostream>
#include <string_view>

#include "experiments.h"

namespace {

int measure(bool quick) {
    using namespace pierce::bench;
    const auto start = std::chrono::steady_clock::now();
    std::cout << "Embree " << embree_version() << ", Bullet " << bullet_version() << ", CGAL " << cgal_version()
              << ", as Debian builds them.\n\n";
    Run run(quick);
    seams(run);
    repeated_steps(run);
    scales(run);
    ends_on_the_plane(run);
    collide_and_slide(run);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    std::cerr << "took " << static_cast<int>(taken.count()) << " s; promises broken by pierce: " << run.failures() << '\n';
    return run.failures() == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    const bool quick = argc == 2 && std::string_view(argv[1]) == "--quick";
    if (argc > 2 || (argc == 2 && !quick)) {
        std::cerr << "usage: trust [--quick]\n";
        return 2;
    }
    try {
        return measure(quick);
    } catch (const std::exception& error) {
        std::cerr << "trust: " << error.what() << '\n';
        return 2;
    }
}

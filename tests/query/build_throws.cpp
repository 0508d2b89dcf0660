// When memory is at an end, a build throws std::bad_alloc, wherever it is and whichever part of it finds out; nothing
// is lost. An executable of its own: it lets one call of operator new after another fail. (An exception that left a
// part of a build would have ended the program: its executor's threads have nobody to catch it.)
#include <cstdio>
#include <new>

#include <pierce/collision_mesh.h>
#include <support/meshes.h>
#include <support/own_new.h>

namespace pierce::test {
namespace {

long left = -1;  // calls until one fails; below 0: none does

/// One part after the other, and none may throw: as a thread of which nobody knows.
struct NobodyCatches {
    void operator()(std::size_t parts, Task task) const {
        for (std::size_t part = 0; part < parts; ++part) {
            const auto run = [&]() noexcept { task(part); };
            run();
        }
    }
};

// The same without exceptions: the status says it, and the text needs no memory.
bool says_so() {
    const TriangleSoup<float> soup = moved<float>(terrain(30, 0.02, 3), 1, Vec3<double>::Zero());
    int said = 0;
    for (long n = 0; n < 100'000; ++n) {
        left = n;
        const Result<CollisionMesh<float>> made = CollisionMesh<float>::try_make(soup.view());
        const bool all_done = left >= 0;
        left = -1;
        if (all_done) return said > 5 && made && made.value.statistics().triangles == soup.triangles.size();
        if (made.status != Status::out_of_memory || made.message != "out of memory") return false;
        if (made.value.statistics().triangles != 0) return false;
        ++said;
    }
    return false;
}

int check() {
    if (!says_so()) {
        std::puts("a build without enough memory said something else");
        return 1;
    }
    const TriangleSoup<float> soup = moved<float>(terrain(150, 0.02, 3), 1, Vec3<double>::Zero());
    const NobodyCatches executor;
    int thrown = 0;
    for (long n = 0; n < 100'000; ++n) {
        try {
            left = n;
            const CollisionMesh<float> mesh(soup.view(), {.executor = executor});
            const bool all_done = left >= 0;
            left = -1;
            if (!all_done) continue;
            std::printf("%d builds without enough memory threw\n", thrown);
            return thrown > 20 && mesh.statistics().triangles == soup.triangles.size() ? 0 : 1;
        } catch (const std::bad_alloc&) {
            left = -1;
            ++thrown;
        }
    }
    std::puts("no build ended well");
    return 1;
}

}  // namespace

void before_new() {
    if (left >= 0 && left-- == 0) throw std::bad_alloc();
}

}  // namespace pierce::test

int main() { return pierce::test::check(); }

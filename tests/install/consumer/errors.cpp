// Errors that the library throws are caught by their own type, and what it defines beside `CollisionMesh` can be
// linked.
#include <array>
#include <cstdio>
#include <span>
#include <string>

#include <pierce/fans.h>
#include <pierce/kernels.h>
#include <pierce/pierce.h>

namespace {

int failures = 0;

template <class Call>
void expect_mesh_error(const char* what, Call call) {
    try {
        call();
        std::printf("%s: no error\n", what);
    } catch (const pierce::MeshError&) {
        return;
    } catch (const std::exception& error) {
        std::printf("%s: not a MeshError: %s\n", what, error.what());
    }
    ++failures;
}

void expect(bool truth, const char* what) {
    if (truth) return;
    std::printf("not so: %s\n", what);
    ++failures;
}

}  // namespace

int main() {
    const std::array<pierce::Vec3<float>, 3> corners = {pierce::Vec3<float>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::array<pierce::IndexTriple, 1> good = {{{0, 1, 2}}};
    const std::array<pierce::IndexTriple, 1> bad = {{{0, 1, 3}}};
    const pierce::MeshView<float> refused{corners, bad};
    expect_mesh_error("a mesh", [&] { const pierce::CollisionMesh<float> mesh(refused); });
    expect_mesh_error("a file", [] { static_cast<void>(pierce::read_mesh<float>("/there/is/none.obj")); });
    expect_mesh_error("a file", [] { static_cast<void>(pierce::read_mesh<double>("/there/is/none.obj")); });
    expect_mesh_error("fans", [&] { static_cast<void>(pierce::fans_of(refused)); });
    expect_mesh_error("one of the user's own", [] { throw pierce::MeshError("thrown here"); });

    const pierce::CollisionMesh<float> mesh(pierce::MeshView<float>{corners, good});
    expect(!mesh.mesh_report().to_string().empty(), "a report has a text");
    const pierce::Vec3<float> from{0.25F, 0.25F, 1};
    const pierce::Vec3<float> to{0.25F, 0.25F, -1};
    expect(pierce::to_string(mesh.explain({from, to}).at(0).reason) == pierce::to_string(pierce::Reason::first_hit),
           "a reason has a text");
    const auto stored = pierce::kernels::exact.prepare(corners[0], corners[1], corners[2]);
    expect(pierce::kernels::exact.test(stored, from, to).has_value(), "the exact kernel");
    return failures == 0 ? 0 : 1;
}

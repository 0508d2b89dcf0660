// What a status says, and what reads without exceptions.
#include <pierce/result.h>

#include <pierce/try_read_mesh.h>
#include <without_exceptions.h>

namespace pierce {

std::string_view to_string(Status status) noexcept {
    switch (status) {
        case Status::ok:
            return "ok";
        case Status::bad_mesh:
            return "bad mesh";
        case Status::bad_file:
            return "bad file";
        case Status::bad_argument:
            return "bad argument";
        case Status::out_of_memory:
            return "out of memory";
        case Status::failed:
            return "failed";
    }
    return "";
}

template <class Scalar>
Result<TriangleSoup<Scalar>> try_read_mesh(const std::filesystem::path& path, const ReadOptions& options) noexcept {
    Result<TriangleSoup<Scalar>> result;
    result.status = detail::without_exceptions([&] { result.value = read_mesh<Scalar>(path, options); },
                                               Status::bad_file, result.message);
    return result;
}

template Result<TriangleSoup<float>> try_read_mesh<float>(const std::filesystem::path&, const ReadOptions&) noexcept;
template Result<TriangleSoup<double>> try_read_mesh<double>(const std::filesystem::path&, const ReadOptions&) noexcept;

}  // namespace pierce

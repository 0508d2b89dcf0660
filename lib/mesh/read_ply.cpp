// PLY: text and both byte orders; positions and corners are picked out of the rows, all else is passed over by its
// type.
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/read_formats.h"
#include "mesh/read_ply_body.h"
#include "mesh/read_ply_header.h"
#include "mesh/read_soup_builder.h"

namespace pierce::detail {
namespace {

constexpr std::array<std::string_view, 3> k_axes = {"x", "y", "z"};

const PlyElement* find_element(const PlyHeader& header, std::string_view name) {
    for (const PlyElement& element : header.elements) {
        if (element.name == name) {
            return &element;
        }
    }
    return nullptr;
}

/// Which elements and properties make the mesh.
struct PlyMesh {
    const PlyElement* vertex = nullptr;
    const PlyElement* face = nullptr;
    std::array<const PlyProperty*, 3> axes{};
    const PlyProperty* corners = nullptr;
};

void find_axes(PlyMesh& mesh, const SourceFile& file) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const PlyProperty& property : mesh.vertex->properties) {
            if (property.name == k_axes[axis] && !property.count_type) {
                mesh.axes[axis] = &property;
            }
        }
        if (mesh.axes[axis] == nullptr) {
            file.fail_at_line(mesh.vertex->place, "element 'vertex' has no number " + quoted(k_axes[axis]));
        }
    }
}

void find_corners(PlyMesh& mesh, const SourceFile& file) {
    for (const PlyProperty& property : mesh.face->properties) {
        if ((property.name != "vertex_indices" && property.name != "vertex_index") || !property.count_type) {
            continue;
        }
        if (mesh.corners != nullptr) {
            file.fail_at_line(property.place, "element 'face' has two lists of corners");
        }
        if (property.type >= PlyType::float32) {
            file.fail_at_line(property.place, "corners can't be floating-point numbers");
        }
        mesh.corners = &property;
    }
    if (mesh.corners == nullptr) {
        file.fail_at_line(mesh.face->place, "element 'face' has no list 'vertex_indices'");
    }
}

PlyMesh find_mesh(const PlyHeader& header, const SourceFile& file) {
    if (const PlyElement* strips = find_element(header, "tristrips"); strips != nullptr && strips->rows > 0) {
        file.fail_at_line(strips->place, "triangle strips are not read");
    }
    PlyMesh mesh{find_element(header, "vertex"), find_element(header, "face"), {}, nullptr};
    if (mesh.face == nullptr || mesh.face->rows == 0) {
        file.fail("holds no face");
    }
    if (mesh.vertex == nullptr) {
        file.fail_at_line(mesh.face->place, "there are faces, but no element 'vertex'");
    }
    find_axes(mesh, file);
    find_corners(mesh, file);
    return mesh;
}

template <class Scalar, class Body>
class PlyReader {
  public:
    PlyReader(const PlyHeader& header, const PlyMesh& mesh, const SourceFile& file)
        : header_(header), mesh_(mesh), body_(header, file), soup_(file) {}

    TriangleSoup<Scalar> read() {
        soup_.reserve(mesh_.vertex->rows, mesh_.face->rows);
        for (const PlyElement& element : header_.elements) {
            // Without properties a row has no bytes, and the count may be anything.
            for (std::uint64_t row = 0; row < element.rows && !element.properties.empty(); ++row) {
                body_.begin_row(element, row);
                read_row(element);
                body_.end_row();
            }
        }
        return soup_.finish();
    }

  private:
    void read_row(const PlyElement& element) {
        Vec3<Scalar> position;
        for (const PlyProperty& property : element.properties) {
            if (&property == mesh_.corners) {
                face();
            } else if (property.count_type) {
                const std::uint64_t length = list_length(property);
                body_.pass(property.type, length);
            } else if (&property == mesh_.axes[0]) {
                position[0] = body_.template coordinate<Scalar>(property.type);
            } else if (&property == mesh_.axes[1]) {
                position[1] = body_.template coordinate<Scalar>(property.type);
            } else if (&property == mesh_.axes[2]) {
                position[2] = body_.template coordinate<Scalar>(property.type);
            } else {
                body_.pass(property.type, 1);
            }
        }
        if (&element == mesh_.vertex) {
            soup_.add_vertex(position);
        }
    }

    void face() {
        const char* first = body_.place();
        const std::uint64_t length = list_length(*mesh_.corners);
        if (length < 3) {
            body_.fail_at(first, too_few_corners(length));
        }
        corners_.clear();
        for (std::uint64_t i = 0; i < length; ++i) {
            const char* place = body_.place();
            const std::int64_t corner = body_.integer(mesh_.corners->type);
            if (corner < 0 || static_cast<std::uint64_t>(corner) >= mesh_.vertex->rows) {
                body_.fail_at(place, corner_out_of_range(std::to_string(corner), mesh_.vertex->rows, true));
            }
            corners_.push_back(static_cast<std::uint32_t>(corner));
        }
        soup_.add_face(corners_);
    }

    std::uint64_t list_length(const PlyProperty& list) {
        const char* first = body_.place();
        const std::int64_t length = body_.integer(*list.count_type);
        if (length < 0) {
            body_.fail_at(first, "a list can't have " + std::to_string(length) + " numbers");
        }
        return static_cast<std::uint64_t>(length);
    }

    const PlyHeader& header_;
    const PlyMesh& mesh_;
    Body body_;
    SoupBuilder<Scalar> soup_;
    std::vector<std::uint32_t> corners_;
};

}  // namespace

template <class Scalar>
TriangleSoup<Scalar> read_ply(const SourceFile& file) {
    const PlyHeader header = read_ply_header(file);
    const PlyMesh mesh = find_mesh(header, file);
    check_sizes(header, mesh.corners, file);
    if (header.format == PlyFormat::text) {
        return PlyReader<Scalar, PlyTextBody>(header, mesh, file).read();
    }
    return PlyReader<Scalar, PlyBinaryBody>(header, mesh, file).read();
}

template TriangleSoup<float> read_ply<float>(const SourceFile&);
template TriangleSoup<double> read_ply<double>(const SourceFile&);

}  // namespace pierce::detail

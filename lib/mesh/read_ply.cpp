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
    const PlyElement* face = nullptr;  ///< none if there are only strips
    std::array<const PlyProperty*, 3> axes{};
    const PlyProperty* corners = nullptr;  ///< of faces
    const PlyProperty* strips = nullptr;   ///< a list of corners in a row, with strips one behind another
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

/// The list of corners in each row of the element.
const PlyProperty* find_corners(const PlyElement& element, const SourceFile& file) {
    const PlyProperty* corners = nullptr;
    for (const PlyProperty& property : element.properties) {
        if ((property.name != "vertex_indices" && property.name != "vertex_index") || !property.count_type) {
            continue;
        }
        if (corners != nullptr) {
            file.fail_at_line(property.place, "element " + quoted(element.name) + " has two lists of corners");
        }
        if (property.type >= PlyType::float32) {
            file.fail_at_line(property.place, "corners can't be floating-point numbers");
        }
        corners = &property;
    }
    if (corners == nullptr) {
        file.fail_at_line(element.place, "element " + quoted(element.name) + " has no list 'vertex_indices'");
    }
    return corners;
}

PlyMesh find_mesh(const PlyHeader& header, const SourceFile& file) {
    const auto find_filled = [&](std::string_view name) {
        const PlyElement* element = find_element(header, name);
        return element != nullptr && element->rows > 0 ? element : nullptr;
    };
    const PlyElement* face = find_filled("face");
    const PlyElement* strips = find_filled("tristrips");
    if (face == nullptr && strips == nullptr) {
        file.fail("holds no face");
    }
    PlyMesh mesh{find_element(header, "vertex"), face, {}, nullptr, nullptr};
    if (mesh.vertex == nullptr) {
        file.fail_at_line((face != nullptr ? face : strips)->place, "there are faces, but no element 'vertex'");
    }
    find_axes(mesh, file);
    mesh.corners = face != nullptr ? find_corners(*face, file) : nullptr;
    mesh.strips = strips != nullptr ? find_corners(*strips, file) : nullptr;
    return mesh;
}

template <class Scalar, class Body>
class PlyReader {
  public:
    PlyReader(const PlyHeader& header, const PlyMesh& mesh, const SourceFile& file, const ReadOptions& options)
        : header_(header), mesh_(mesh), body_(header, file), soup_(file, options) {}

    TriangleSoup<Scalar> read() {
        soup_.reserve(mesh_.vertex->rows, mesh_.face != nullptr ? mesh_.face->rows : 0);
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
            } else if (&property == mesh_.strips) {
                strips();
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
            corners_.push_back(vertex_of(body_.integer(mesh_.corners->type), place));
        }
        soup_.add_face(corners_);
    }

    /// Strips of triangles, with a -1 between one and the next. Each corner from the third on makes a face with the two
    /// before it, every other one turned round, so that all of a strip face the same way (Turk's `tristrips`, as in the
    /// files of the Stanford 3D scanning repository). Nothing is dropped: a corner that is repeated, to turn or to jump
    /// to another place, makes faces of zero area.
    void strips() {
        const std::uint64_t length = list_length(*mesh_.strips);
        const char* first = body_.place();
        std::array<std::uint32_t, 2> before{};
        std::uint64_t corners = 0;
        for (std::uint64_t i = 0; i < length; ++i) {
            const char* place = body_.place();
            const std::int64_t number = body_.integer(mesh_.strips->type);
            if (number == -1) {
                end_strip(corners, first);
                first = body_.place();
                corners = 0;
                continue;
            }
            const std::uint32_t corner = vertex_of(number, place);
            if (corners >= 2) {
                const std::size_t turned = corners % 2;
                soup_.add_face(std::array{before[turned], before[1 - turned], corner});
            }
            before = {before[1], corner};
            ++corners;
        }
        end_strip(corners, first);
    }

    /// Nothing between two -1 is nothing to lose.
    void end_strip(std::uint64_t corners, const char* first) {
        if (corners == 1 || corners == 2) {
            body_.fail_at(first, too_few_corners(corners, "strip"));
        }
    }

    std::uint32_t vertex_of(std::int64_t corner, const char* place) {
        if (corner < 0 || static_cast<std::uint64_t>(corner) >= mesh_.vertex->rows) {
            body_.fail_at(place, index_out_of_range(soup_.face_count(), std::to_string(corner), mesh_.vertex->rows,
                                                    ", counted from 0"));
        }
        return static_cast<std::uint32_t>(corner);
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
TriangleSoup<Scalar> read_ply(const SourceFile& file, const ReadOptions& options) {
    const PlyHeader header = read_ply_header(file);
    const PlyMesh mesh = find_mesh(header, file);
    check_sizes(header, mesh.corners, file);
    if (header.format == PlyFormat::text) {
        return PlyReader<Scalar, PlyTextBody>(header, mesh, file, options).read();
    }
    return PlyReader<Scalar, PlyBinaryBody>(header, mesh, file, options).read();
}

template TriangleSoup<float> read_ply<float>(const SourceFile&, const ReadOptions&);
template TriangleSoup<double> read_ply<double>(const SourceFile&, const ReadOptions&);

}  // namespace pierce::detail

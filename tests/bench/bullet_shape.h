// Bullet's shape for a static triangle mesh, for whoever asks it. In float, as Debian builds it.
#pragma once

#include <btBulletCollisionCommon.h>

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <pierce/triangle_soup.h>

namespace pierce::bench {

static_assert(sizeof(btScalar) == sizeof(float));

/// Reads the mesh's arrays for as long as it lives.
class BulletShape {
  public:
    explicit BulletShape(const MeshView<float>& mesh)
        : triangles_(part(mesh)), shape_(&triangles_, true) {}  // quantized boxes: "recommended", says its header

    btBvhTriangleMeshShape& get() { return shape_; }

  private:
    struct Triangles : btTriangleIndexVertexArray {
        explicit Triangles(const btIndexedMesh& part) { addIndexedMesh(part); }
    };

    static btIndexedMesh part(const MeshView<float>& mesh) {
        btIndexedMesh part;
        part.m_numTriangles = static_cast<int>(mesh.triangles.size());
        part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(mesh.triangles.data());
        part.m_triangleIndexStride = static_cast<int>(mesh.triangles.stride());
        part.m_numVertices = static_cast<int>(mesh.positions.size());
        part.m_vertexBase = reinterpret_cast<const unsigned char*>(mesh.positions.data());
        part.m_vertexStride = static_cast<int>(mesh.positions.stride());
        return part;
    }

    Triangles triangles_;
    btBvhTriangleMeshShape shape_;
};

}  // namespace pierce::bench

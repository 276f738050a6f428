#pragma once

#include "model/tri_mesh.h"

#include <Eigen/Core>

#include <memory>

namespace vcarve {

/// A surface made ready for two questions: how far is it, and does it stand in the way. Both may be
/// asked from any number of threads; answers are in doubles and do not depend on their order.
/// Questions are put in the frame of the mesh's positions, its offset plays no part: a mesh far
/// from zero should be centred first. Faces without area are left out. The mesh itself is not kept.
/// Cost: O(n log n) to build, O(log n) a question on usual meshes; about 400 bytes a face.
class SurfaceTree {
  public:
    /// Precondition: the mesh has at least one face with area and finite corners.
    explicit SurfaceTree(const TriMesh& mesh);
    ~SurfaceTree();
    SurfaceTree(SurfaceTree&&) noexcept;
    SurfaceTree& operator=(SurfaceTree&&) noexcept;

    /// From a point to the nearest point of the surface.
    double distance(const Eigen::Vector3d& point) const;

    /// Whether the closed segment meets the surface, from whichever side.
    bool blocks(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  private:
    struct Tree;
    std::unique_ptr<const Tree> tree_;
};

} // namespace vcarve

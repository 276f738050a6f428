#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>

namespace vcarve {

/// The first hit of a ray with a mesh.
struct FirstFace {
    static constexpr std::uint32_t kNone = 0xffffffffU;

    std::uint32_t face = kNone;
    float second = 0.0F; ///< barycentric coordinate of the second corner
    float third = 0.0F;  ///< barycentric coordinate of the third corner
};

/// Finds the first face on rays from one viewpoint with Embree. Corners are float32 relative to
/// this point, so directions are exact to 1e-7 rad, even if the mesh is far from the origin. No ray
/// passes through an edge. Results do not depend on the thread count, because one thread builds the
/// tree. Queries are thread-safe. The mesh is not referenced after construction.
/// Cost: O(n log n) to build, O(log n) per ray for usual meshes; about 150 bytes per face.
class FirstFaces {
  public:
    /// `eye` is in the frame of mesh.positions.
    FirstFaces(const TriMesh& mesh, const Eigen::Vector3d& eye);
    ~FirstFaces();
    FirstFaces(const FirstFaces&) = delete;
    FirstFaces& operator=(const FirstFaces&) = delete;

    /// Returns the first face on a ray from the eye, seen from either side. `direction` must be a
    /// unit vector. Faces without area are not hit.
    FirstFace along(const Eigen::Vector3d& direction) const;
    /// Like along(), but hits only front sides, on which corners are counterclockwise.
    FirstFace front_along(const Eigen::Vector3d& direction) const;
    /// Like along(), but from another point in the frame of mesh.positions, also rounded to float.
    FirstFace from(const Eigen::Vector3d& place, const Eigen::Vector3d& direction) const;

  private:
    FirstFace first(const Eigen::Vector3f& start, const Eigen::Vector3d& direction,
                    bool only_fronts) const;

    struct Tree;
    std::unique_ptr<Tree> tree_;
    Eigen::Vector3d eye_;
    double scale_ = 1.0; ///< puts the farthest corner at a distance of about 1
};

} // namespace vcarve

#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <memory>
#include <optional>

namespace vcarve {

/// Where a ray first meets a surface.
struct FirstHit {
    double along = 0.0; ///< the way there in lengths of the ray's `from` to `towards`
    bool front = false; ///< from the side its face's normal looks to
};

/// Where a surface is nearest to a point.
struct NearestFace {
    double distance = 0.0;
    Eigen::Vector3d normal; ///< of the face, unit
};

/// A surface made ready for three questions: how far is it, does it stand in the way, and where
/// does a ray first meet it. All may be asked from any number of threads; answers are in doubles
/// and do not depend on their order.
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
    /// The same, with the face that is nearest; of several equally near, any one.
    NearestFace nearest(const Eigen::Vector3d& point) const;

    /// Whether the closed segment meets the surface, from whichever side.
    bool blocks(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

    /// Where the ray from `from` through `towards` and beyond first meets the surface; nothing
    /// where it does not. Whether it meets a face, its border included, is decided in exact
    /// arithmetic, so no ray slips through an edge or a vertex. A face it runs along counts only by
    /// its neighbours. Of two faces equally far, the front. Precondition: `from` != `towards`.
    std::optional<FirstHit> first_hit(const Eigen::Vector3d& from,
                                      const Eigen::Vector3d& towards) const;

  private:
    struct Tree;
    std::unique_ptr<const Tree> tree_;
};

} // namespace vcarve

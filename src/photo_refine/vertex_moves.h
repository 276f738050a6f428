#pragma once

#include "base/arrays.h"
#include "photo_refine/photo_curves.h"

#include <Eigen/Core>

#include <memory>
#include <span>
#include <vector>

namespace vcarve {

/// Where the photographs want a vertex.
struct WantedShift {
    float steps = 0.0F;  ///< along the normal
    float weight = 0.0F; ///< inverse variance, up to a factor; 0: unknown
};

/// The minimum of a curve, by a parabola. The weight is its curvature divided by the remaining
/// disagreement, which is proportional to the inverse variance of the minimum.
WantedShift wanted_shift(const PhotoCurve& curve);

/// The neighbors of each vertex, each once; a boundary vertex lacks one. Cost: O(faces).
RowTable neighbors_of(const TriMesh& mesh);

/// Finds shifts of vertices along their normals, in steps.
class ShiftSolver {
  public:
    /// The arguments must outlive the object. Cost: O(vertices); 100 bytes per vertex.
    ShiftSolver(const TriMesh& mesh, std::span<const Eigen::Vector3d> normals,
                std::span<const float> steps, const RowTable& neighbors);
    ~ShiftSolver();
    ShiftSolver(const ShiftSolver&) = delete;
    ShiftSolver& operator=(const ShiftSolver&) = delete;

    /// The shifts that the photographs want, as far as the surface stays smooth: minimizes the
    /// weighted squared distances to the wanted shifts, and the squared bending of the surface (a
    /// thin plate) times `stiffness`, by conjugate gradients. Faces across a crease do not bend
    /// each other. Cost: 25 products with a matrix of 7 entries per vertex.
    Eigen::VectorXd shifts(std::span<const WantedShift> wanted, double stiffness) const;

    /// Positions of the shifted vertices. They move by at most two steps, and so that no face turns
    /// by more than 60 degrees. On smooth parts, they also spread evenly.
    std::vector<Eigen::Vector3d> moved(const Eigen::VectorXd& shifts) const;

  private:
    struct Plate;
    const TriMesh& mesh_;
    std::span<const Eigen::Vector3d> normals_;
    std::span<const float> steps_;
    std::unique_ptr<const Plate> plate_;
};

/// The unit normals of vertices: the mean of the normals of their faces, weighted by angle. Cost:
/// O(faces), in parallel.
std::vector<Eigen::Vector3d> normals_of_vertices(const TriMesh& mesh);

} // namespace vcarve

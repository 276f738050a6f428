#pragma once

#include "mesh/vertices.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

namespace vcarve {

/// How long the edges around a vertex are. Medians cost more than all else that is asked about a
/// surface, so they are taken when first asked for. Safe from many threads. Keeps references to
/// positions and faces.
class LocalEdges {
  public:
    /// Only the faces with a flag are measured; all where there are no flags. Cost: O(faces).
    LocalEdges(std::span<const Eigen::Vector3d> positions, const std::vector<Face>& faces,
               const FaceFlags& measured = {});

    /// The measured faces at each vertex.
    const VertexFaces& faces_at() const { return faces_at_; }

    /// The median length of the edges of the measured faces around a vertex; 0 where there are
    /// none.
    double median(std::uint32_t vertex) const;

    double longest_edge(std::size_t face) const;

    /// The longest edge of a face over the median at its middle corner: not at the one that knows
    /// only the face itself, nor at the one in the densest place. Infinite or NaN where no face
    /// around is measured.
    double relative_size(std::size_t face) const;

  private:
    double squared_length(std::uint32_t a, std::uint32_t b) const
    {
        return (positions_[a] - positions_[b]).squaredNorm();
    }
    void collect_squared_lengths(std::uint32_t vertex, std::vector<double>& lengths_sq) const;

    std::span<const Eigen::Vector3d> positions_;
    const std::vector<Face>& faces_;
    VertexFaces faces_at_;
    mutable std::vector<double> medians_; ///< negative where not known yet
};

/// How a surface runs at its vertices, as its small faces tell: those without an edge of two local
/// edges or more. Only the faces that `edges` measures count. Keeps references. Safe from many
/// threads.
class SurfaceNormals {
  public:
    SurfaceNormals(std::span<const Eigen::Vector3d> positions, const std::vector<Face>& faces,
                   const LocalEdges& edges)
        : positions_(positions), faces_(faces), edges_(edges)
    {
    }

    /// The normal of a face: unit, pointing outside; zero where the face has no area.
    Eigen::Vector3d of(std::size_t face) const;

    /// The mean normal of the small faces around a vertex; zero where there are none.
    Eigen::Vector3d at(std::uint32_t vertex) const;

    /// The cosines of the angles between a face and the surface at its three corners, ascending.
    /// A corner without small faces knows nothing and has `unknown`.
    std::array<double, 3> cosines(std::size_t face, double unknown) const;

  private:
    std::span<const Eigen::Vector3d> positions_;
    const std::vector<Face>& faces_;
    const LocalEdges& edges_;
};

/// Whether a face goes on with the surface at one of its corners at least: within 26 degrees of the
/// small faces there.
bool goes_on(std::size_t face, const SurfaceNormals& normals);

} // namespace vcarve

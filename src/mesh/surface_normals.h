#pragma once

#include "mesh/local_edges.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <array>
#include <span>

namespace vcarve {

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

#pragma once

#include "mesh/vertices.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

namespace vcarve {

/// Median edge lengths at vertices. Medians dominate the cost of local measurements, so they are
/// computed on first use and cached. Thread-safe. Keeps references to positions and faces.
class LocalEdges {
  public:
    /// Measures only flagged faces, or all if `measured` is empty. Cost: O(faces).
    LocalEdges(std::span<const Eigen::Vector3d> positions, const std::vector<Face>& faces,
               const FaceFlags& measured = {});

    /// The measured faces at each vertex.
    const VertexFaces& faces_at() const { return faces_at_; }

    /// The median length of all edges of the measured faces at a vertex; 0 without such faces.
    double median(std::uint32_t vertex) const;

    double longest_edge(std::size_t face) const;

    /// The longest edge of a face, divided by the second largest median() of its corners. The
    /// largest may stem from the face alone, the smallest from a much denser region.
    /// Infinite or NaN if no face around is measured.
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
    mutable std::vector<double> medians_; ///< negative if not computed yet
};

/// Surface normals at vertices, estimated from small faces: measured faces of `edges` whose
/// relative size is below 2. Keeps references. Thread-safe.
class SurfaceNormals {
  public:
    SurfaceNormals(std::span<const Eigen::Vector3d> positions, const std::vector<Face>& faces,
                   const LocalEdges& edges)
        : positions_(positions), faces_(faces), edges_(edges)
    {
    }

    /// The unit normal of a face, pointing outside; zero if the face has no area.
    Eigen::Vector3d of(std::size_t face) const;

    /// The mean normal of the small faces at a vertex, normalized; zero without small faces.
    Eigen::Vector3d at(std::uint32_t vertex) const;

    /// The cosines of the angles between a face and the surface at its three corners, ascending.
    /// A corner without small faces gets `unknown`.
    std::array<double, 3> cosines(std::size_t face, double unknown) const;

  private:
    std::span<const Eigen::Vector3d> positions_;
    const std::vector<Face>& faces_;
    const LocalEdges& edges_;
};

/// Whether a face continues the surface at one or more corners: its normal is within 26 degrees of
/// the normal of the small faces there.
bool continues_surface(std::size_t face, const SurfaceNormals& normals);

} // namespace vcarve

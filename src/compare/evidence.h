#pragma once

#include "base/progress.h"
#include "compare/reference.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace vcarve {

/// Figures of the rays of view_rays().
struct RayFigures {
    double back_faces_seen = 0.0; ///< fraction of rays that first hit a back face
    /// Fraction of rays that miss the mesh but hit the closed surface. Nothing if there is no
    /// closed surface.
    std::optional<double> nothing_seen;
};

/// Returns rays through the centers of a grid of nearly square cells in every image: at most
/// options.samples / 4 in total, or 36 per image if that is more. Pixels without a direction, and
/// cameras without size or known lens, have no rays.
std::vector<ViewRay> view_rays(const Scene& scene, const CompareOptions& options);

/// Fills Reference::closed_hits. `closed` is a surface of the reference's model, in any frame.
void use_closed_surface(Reference& reference, const TriMesh& closed);

/// Returns nothing if no view has a ray. Cost: one query per ray, parallel.
std::optional<RayFigures> measure_view_rays(const MeasuredMesh& mesh, const Reference& reference);

/// Makes the closed surface of the reference's model, like `colmap-vcarve --closed`, and records
/// which of the reference's rays hit it, in the stage "closed". `model` is the model that the
/// reference was made from. Does nothing if there are no rays. If there is no surface, adds a note
/// and leaves the reference unchanged. Cost: that of reconstruct().
void add_closed_surface(Reference& reference, Scene model, Log& log);

/// Compares a mesh with what the views saw; needs neither truth nor a unit of length. k spacings
/// are options.spacings times the spacing of the point (see point_spacings()). The points are those
/// of Reference::scene.
struct EvidenceFigures {
    /// Fraction of the rays (point to view) that hit the mesh farther than k spacings from the
    /// point: the mesh occludes an observed point.
    double hidden_rays = 0.0;
    /// Fraction of the points farther than k spacings from the mesh.
    double missed_points = 0.0;
    /// Fraction of the mesh's area that no view sees from its front. A view sees a position if the
    /// normal faces it (cosine above 0.05), its image contains the position (see view_shows()), and
    /// the mesh does not occlude it.
    double unsupported_area = 0.0;
    /// Median of the points' distances to the mesh, each divided by the point's spacing.
    double median_distance = 0.0;
    /// Number of boundary edges whose midpoint a view sees (see view_sees()).
    std::int64_t seen_boundary_edges = 0;
    std::optional<RayFigures> rays; ///< if a view has a ray
};

/// Uses at most options.samples rays, spread evenly, and an eighth of options.samples for the area.
/// Cost: a segment query per ray, a nearest-point query per point, up to one segment query per view
/// for each area sample and boundary edge, and measure_view_rays(); parallel.
EvidenceFigures measure_against_views(const MeasuredMesh& mesh, const Reference& reference);

/// Whether a view sees a position on the mesh, from either side: its image shows the position and
/// the mesh does not occlude it.
bool view_sees(const View& view, const Eigen::Vector3d& position, const MeasuredMesh& mesh,
               const Reference& reference);

} // namespace vcarve

#pragma once

#include "base/progress.h"
#include "compare/reference.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace vcarve {

/// What the views see of a mesh, wherever they look.
struct RayFigures {
    double back_faces_seen = 0.0; ///< share of the rays that first meet the mesh from its back
    /// Share of the rays that meet no face where the closed surface has one; nothing where there is
    /// no closed surface.
    std::optional<double> nothing_seen;
};

/// The lines of sight through the middles of a grid of about square cells in every image: at most
/// as many cells an image as make options.samples / 4 in all, or 36 where that is more. Pixels
/// without a direction, and cameras without size or known lens, have none.
std::vector<ViewRay> view_rays(const Scene& scene, const CompareOptions& options);

/// Fills Reference::closed_hits. `closed` is a surface of the reference's model, in any frame.
void use_closed_surface(Reference& reference, const TriMesh& closed);

/// Nothing where no view has a ray. Cost: a ray each, parallel.
std::optional<RayFigures> measure_view_rays(const MeasuredMesh& mesh, const Reference& reference);

/// Makes the closed surface of the reference's model, as `colmap-vcarve --closed` does, and notes
/// which of the reference's rays meet it, as the stage "closed". `model` is what the reference was
/// made from. Where no surface can be made of it, a note says why and the reference stays as it is;
/// so it does where there are no rays. Cost: that of reconstruct().
void add_closed_surface(Reference& reference, Scene model, Log& log);

/// A mesh against what the views saw; needs no truth and no unit of length. "k spacings" is
/// options.spacings times the point's own spacing (see point_spacings), and only points with at
/// least two views take part.
struct EvidenceFigures {
    /// Share of the sights (point to view) that meet the mesh farther than k spacings from the
    /// point: the mesh hides the point from a view that saw it.
    double hidden_sights = 0.0;
    /// Share of the points farther than k spacings from the mesh.
    double missed_points = 0.0;
    /// Share of the mesh's area that no view sees from its front: where for every view the normal
    /// looks away from it (cosine at most 0.05), its image ends before (see image_shows), or the
    /// mesh itself lies between.
    double unsupported_area = 0.0;
    /// Median of the points' distances to the mesh, each divided by the point's spacing.
    double median_distance = 0.0;
    /// Edges of one face whose middle some view sees: within its image, nothing of the mesh between
    /// from whichever side.
    std::int64_t seen_boundary_edges = 0;
    std::optional<RayFigures> rays; ///< where some view has a ray
};

/// Every sight counts where there are at most options.samples of them, else that many spread evenly
/// over them; the area is judged by an eighth of options.samples. Cost: a segment query a sight, a
/// nearest-point query a point, up to views segment queries for each sample of area and each
/// boundary edge, and what measure_view_rays takes; parallel.
EvidenceFigures measure_against_views(const MeasuredMesh& mesh, const Reference& reference);

/// Whether a view sees a place of the mesh, from whichever side: its image holds it and the mesh
/// does not stand between.
bool view_sees(const View& view, const Eigen::Vector3d& position, const MeasuredMesh& mesh,
               const Reference& reference);

} // namespace vcarve

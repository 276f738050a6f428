#pragma once

#include "base/log.h"
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

} // namespace vcarve

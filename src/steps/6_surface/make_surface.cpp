#include "steps/6_surface/make_surface.h"

#include "steps/4_visibility/face_visibility.h"
#include "steps/5_labels/boundary.h"
#include "steps/6_surface/extract.h"
#include "steps/6_surface/face_rules.h"
#include "steps/6_surface/trim.h"
#include "vcarve/error.h"

#include <utility>
#include <vector>

namespace vcarve {

namespace {

void require_faces(const MadeSurface& made)
{
    if (!made.seen.faces.faces.empty()) return;
    if (made.out_of_region > 0) {
        throw InputError("no face of the surface lies within the region of --crop");
    }
    throw InputError("the sights leave no surface: no part of the space behind the points is seen "
                     "well enough");
}

} // namespace

MadeSurface make_surface(Labels labels, const SurfaceInput& input, const SurfaceOptions& options,
                         const Progress& progress)
{
    const auto& [cells, scene, region, removed] = input;
    Removals removals(removed);
    if (options.closed) close_hull(cells, labels);
    const std::vector<CellFacet> facets = boundary_facets(cells, labels);
    TriMesh surface = extract_surface(cells, facets, scene);
    progress.tell(0.2);
    const FaceVisibility visibility(cells, labels, scene);
    progress.tell(0.4);
    ChosenFaces chosen = choose_faces({surface, facets, visibility}, region, options, removals);
    progress.tell(0.7);
    MadeSurface made = {
        .unseen = chosen.unseen, .closing = chosen.closing, .out_of_region = chosen.out_of_region};
    // What a region leaves out is not open, nor what is trimmed, which no view sees.
    if (!options.closed && region == nullptr) {
        made.seen.openness = measure_openness(cells, labels, facets, chosen.keep, scene);
    }
    if (!options.closed) {
        made.trimmed = trim_faces(surface, facets, visibility, options.rules, chosen);
        removals.note(chosen.keep, Removal::trimmed);
    }
    removals.add_noted(surface);
    made.seen.faces = with_faces(std::move(surface), chosen.keep);
    require_faces(made);
    return made;
}

} // namespace vcarve

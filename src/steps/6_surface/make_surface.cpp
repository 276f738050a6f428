#include "steps/6_surface/make_surface.h"

#include "mesh/half_edge_mesh.h"
#include "steps/4_visibility/face_visibility.h"
#include "steps/5_labels/boundary.h"
#include "steps/6_surface/extract.h"
#include "steps/6_surface/face_rules.h"
#include "steps/6_surface/trim.h"
#include "vcarve/error.h"

#include <array>
#include <utility>
#include <vector>

namespace vcarve {

SeenSurface seen_surface(const TetMesh& cells, Labels labels, const Scene& scene,
                         const SurfaceWishes& wishes, const SurfaceOptions& options, Log& log)
{
    Stage stage(log, "surface");
    Removals removals(wishes.removed);
    if (options.closed) close_hull(cells, labels);
    const std::vector<CellFacet> facets = boundary_facets(cells, labels);
    TriMesh surface = extract_surface(cells, facets, scene);
    stage.progress(0.2);
    const FaceVisibility visibility(cells, labels, scene);
    stage.progress(0.4);
    ChosenFaces chosen =
        choose_faces({surface, facets, visibility}, wishes.region, options, removals);
    stage.progress(0.7);
    SeenSurface seen;
    std::int64_t trimmed = 0;
    // What a region leaves out is not open, nor what is trimmed, which no view sees.
    if (!options.closed && wishes.region == nullptr) {
        seen.openness = measure_openness(cells, labels, facets, chosen.keep, scene);
    }
    if (!options.closed) {
        trimmed = trim_faces(surface, facets, visibility, options.rules, chosen);
        removals.note(chosen.keep, Removal::trimmed);
    }
    removals.add_noted(surface);
    surface = with_faces(std::move(surface), chosen.keep);
    Counts counts = {{"faces", size_of(surface.faces.size())},
                     {"unseen", chosen.unseen},
                     {"closing without support", chosen.closing},
                     {"trimmed", trimmed}};
    if (wishes.region != nullptr) counts.emplace_back("outside the region", chosen.out_of_region);
    stage.end(counts);
    if (surface.faces.empty() && chosen.out_of_region > 0) {
        throw InputError("no face of the surface lies within the region of --crop");
    }
    if (surface.faces.empty()) {
        throw InputError("the sights leave no surface: no part of the space behind the points is "
                         "seen well enough");
    }
    seen.faces = std::move(surface);
    return seen;
}

namespace {

CleanSurface clean(TriMesh surface, const SurfaceOptions& options, Log& log)
{
    Stage stage(log, "clean");
    CleanSurface cleaned = clean_surface(std::move(surface), options.cleanup);
    const CleanupCounts& counts = cleaned.counts;
    stage.end({{"vertices", counts.vertices},
               {"faces", counts.faces},
               {"split edges", counts.split_edges},
               {"split vertices", counts.split_vertices},
               {"components dropped", counts.removed_components},
               {"holes filled", counts.filled_holes}});
    return cleaned;
}

/// How much of what the views look at is open, holes that were filled left out.
void tell_openness(const Openness& openness, const CleanSurface& cleaned, Log& log)
{
    Stage stage(log, "open");
    std::vector<std::array<Eigen::Vector3d, 3>> filled;
    for (std::size_t i = cleaned.first_filled; i < cleaned.mesh->n_faces(); ++i) {
        filled.push_back(cleaned.mesh->triangle(handle_at<OpenMesh::FaceHandle>(i)));
    }
    stage.end({{"rays of the views", count_free(openness.open, filled)}, {"of", openness.rays}});
}

} // namespace

std::unique_ptr<HalfEdgeMesh> mended_surface(SeenSurface seen, RemovedFaces* removed,
                                             const SurfaceOptions& options, Log& log)
{
    CleanSurface cleaned = clean(std::move(seen.faces), options, log);
    Removals(removed).add_deleted(*cleaned.mesh, cleaned.first_filled);
    if (seen.openness) tell_openness(*seen.openness, cleaned, log);
    return std::move(cleaned.mesh);
}

} // namespace vcarve

#include "steps/5_surface/make_surface.h"

#include "mesh/half_edge_mesh.h"
#include "steps/3_visibility/face_visibility.h"
#include "steps/5_surface/extract.h"
#include "vcarve/error.h"

#include <utility>
#include <vector>

namespace vcarve {

namespace {

TriMesh extract(Labelling labelling, const Scene& scene, const SurfaceOptions& options, Log& log)
{
    Stage stage(log, "surface");
    const std::vector<CellFacet> facets = labelling.facets();
    labelling.forget_boundary(); // the surface is numbered and measured anew
    TriMesh surface = extract_surface(labelling.cells(), facets, scene);
    stage.progress(0.2);
    FaceFlags keep(facets.size(), 1);
    std::int64_t sheets = 0;
    if (!options.closed) {
        const FaceVisibility visibility(labelling.cells(), labelling.labels(), scene);
        stage.progress(0.4);
        keep = supported_faces(surface, facets, visibility, scene, options.support);
        stage.progress(0.7);
        sheets = peel_sheets(surface, facets, visibility, options.sheets, keep);
    }
    surface = with_faces(std::move(surface), keep);
    const std::int64_t dropped = size_of(facets.size() - surface.faces.size());
    stage.end({{"faces", size_of(surface.faces.size())},
               {"unseen", dropped - sheets},
               {"sheets", sheets}});
    if (surface.faces.empty()) {
        throw InputError("the sights leave no surface: no part of the space behind the points is "
                         "seen well enough");
    }
    return surface;
}

std::unique_ptr<HalfEdgeMesh> clean(TriMesh surface, const SurfaceOptions& options, Log& log)
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
    return std::move(cleaned.mesh);
}

} // namespace

std::unique_ptr<HalfEdgeMesh> make_surface(Labelling labelling, const Scene& scene,
                                           const SurfaceOptions& options, Log& log)
{
    return clean(extract(std::move(labelling), scene, options, log), options, log);
}

} // namespace vcarve

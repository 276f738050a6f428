#include "steps/5_surface/make_surface.h"

#include "base/parallel.h"
#include "mesh/half_edge_mesh.h"
#include "steps/3_visibility/face_visibility.h"
#include "steps/5_surface/extract.h"
#include "vcarve/error.h"

#include <utility>
#include <vector>

namespace vcarve {

namespace {

/// Takes the flags off faces with a corner outside the region; how many there were.
std::int64_t leave_region(const TriMesh& surface, const Region& region, FaceFlags& keep)
{
    std::vector<std::uint8_t> is_inside(surface.positions.size());
    parallel_for(is_inside.size(), [&](std::size_t vertex) {
        is_inside[vertex] = region.contains(surface.positions[vertex]) ? 1 : 0;
    });
    std::int64_t left = 0;
    for (std::size_t face = 0; face < keep.size(); ++face) {
        const auto& [a, b, c] = surface.faces[face];
        if (keep[face] == 0 || (is_inside[a] & is_inside[b] & is_inside[c]) != 0) continue;
        keep[face] = 0;
        ++left;
    }
    return left;
}

TriMesh extract(Labelling labelling, const Scene& scene, const Region* region,
                const SurfaceOptions& options, Log& log)
{
    Stage stage(log, "surface");
    const std::vector<CellFacet> facets = labelling.facets();
    labelling.forget_boundary(); // the surface is numbered and measured anew
    TriMesh surface = extract_surface(labelling.cells(), facets, scene);
    stage.progress(0.2);
    FaceFlags keep(facets.size(), 1);
    std::int64_t sheets = 0;
    std::int64_t cropped = 0;
    if (!options.closed) {
        const FaceVisibility visibility(labelling.cells(), labelling.labels(), scene);
        stage.progress(0.4);
        keep = supported_faces(surface, facets, visibility, scene, options.support);
        stage.progress(0.7);
        if (region != nullptr) cropped = leave_region(surface, *region, keep);
        sheets = peel_sheets(surface, facets, visibility, options.sheets, keep);
    } else if (region != nullptr) {
        cropped = leave_region(surface, *region, keep);
    }
    surface = with_faces(std::move(surface), keep);
    const std::int64_t dropped = size_of(facets.size() - surface.faces.size());
    Counts counts = {{"faces", size_of(surface.faces.size())},
                     {"unseen", dropped - sheets - cropped},
                     {"sheets", sheets}};
    if (region != nullptr) counts.emplace_back("outside the region", cropped);
    stage.end(counts);
    if (surface.faces.empty() && cropped > 0) {
        throw InputError("no face of the surface lies within the region of --crop");
    }
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
                                           const Region* region, const SurfaceOptions& options,
                                           Log& log)
{
    return clean(extract(std::move(labelling), scene, region, options, log), options, log);
}

} // namespace vcarve

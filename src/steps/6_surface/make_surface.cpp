#include "steps/6_surface/make_surface.h"

#include "base/parallel.h"
#include "mesh/half_edge_mesh.h"
#include "steps/4_visibility/face_visibility.h"
#include "steps/6_surface/extract.h"
#include "steps/6_surface/removals.h"
#include "steps/6_surface/rims.h"
#include "steps/6_surface/trim.h"
#include "vcarve/error.h"

#include <algorithm>
#include <array>
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

/// The other faces.
FaceFlags without(const FaceFlags& keep)
{
    FaceFlags others(keep.size());
    std::ranges::transform(keep, others.begin(),
                           [](std::uint8_t flag) -> std::uint8_t { return flag == 0 ? 1 : 0; });
    return others;
}

/// The surface of a labelling, face by face that of facets which ascend.
struct ClosedSurface {
    const TriMesh& surface;
    const std::vector<CellFacet>& facets;
    const FaceVisibility& visibility;
};

/// Which faces of a boundary are kept.
struct Choice {
    FaceFlags keep;
    FaceFlags unseen; ///< by all views; those that are kept round a rim off
    std::int64_t sheets = 0;
    std::int64_t cropped = 0;
};

Choice all_faces(const TriMesh& surface, const Region* region, Removals& removals)
{
    Choice choice;
    choice.keep.assign(surface.faces.size(), 1);
    if (region != nullptr) choice.cropped = leave_region(surface, *region, choice.keep);
    removals.note(choice.keep, Removal::outside_region);
    return choice;
}

/// Without what no view sees, and without sheets.
Choice faces_to_keep(const ClosedSurface& boundary, const Scene& scene, const Region* region,
                     const SurfaceOptions& options, Removals& removals)
{
    const auto& [surface, facets, visibility] = boundary;
    Choice choice;
    choice.keep = supported_faces(surface, facets, visibility, scene, options.support);
    removals.note(choice.keep, Removal::unseen);
    choice.unseen = without(choice.keep);
    if (region != nullptr) choice.cropped = leave_region(surface, *region, choice.keep);
    removals.note(choice.keep, Removal::outside_region);
    choice.sheets = peel_sheets(surface, facets, visibility, options.sheets, choice.keep);
    removals.note(choice.keep, Removal::sheet);
    round_off_rims(surface, facets, visibility, choice.unseen, choice.keep);
    if (region != nullptr) leave_region(surface, *region, choice.keep);
    removals.note(choice.keep, Removal::outside_region);
    return choice;
}

} // namespace

SeenSurface seen_surface(Labelling labelling, const Scene& scene, const SurfaceWishes& wishes,
                         const SurfaceOptions& options, Log& log)
{
    Stage stage(log, "surface");
    Removals removals(wishes.removed);
    if (options.closed) labelling.close_hull();
    const std::vector<CellFacet> facets = labelling.facets();
    labelling.forget_boundary(); // the surface is numbered and measured anew
    TriMesh surface = extract_surface(labelling.cells(), facets, scene);
    stage.progress(0.2);
    const FaceVisibility visibility(labelling.cells(), labelling.labels(), scene);
    stage.progress(0.4);
    Choice choice = options.closed ? all_faces(surface, wishes.region, removals)
                                   : faces_to_keep({surface, facets, visibility}, scene,
                                                   wishes.region, options, removals);
    const std::int64_t dropped = std::ranges::count(choice.keep, 0);
    stage.progress(0.7);
    SeenSurface seen;
    std::int64_t trimmed = 0;
    // What a region leaves out is not open, nor what is trimmed, which no view sees.
    if (!options.closed && wishes.region == nullptr) {
        seen.openness =
            measure_openness(labelling.cells(), labelling.labels(), facets, choice.keep, scene);
    }
    if (!options.closed) {
        TrimmedFaces faces =
            trim_faces(surface, facets, visibility, {choice.unseen, options}, choice.keep);
        trimmed = faces.count;
        seen.filled = std::move(faces.filled);
        removals.note(choice.keep, Removal::trimmed);
    }
    removals.add_noted(surface);
    surface = with_faces(std::move(surface), choice.keep);
    Counts counts = {{"faces", size_of(surface.faces.size())},
                     {"unseen", dropped - choice.sheets - choice.cropped},
                     {"sheets", choice.sheets},
                     {"trimmed", trimmed}};
    if (wishes.region != nullptr) counts.emplace_back("outside the region", choice.cropped);
    stage.end(counts);
    if (surface.faces.empty() && choice.cropped > 0) {
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
void tell_openness(const Openness& openness, std::vector<std::array<Eigen::Vector3d, 3>> filled,
                   const CleanSurface& cleaned, Log& log)
{
    Stage stage(log, "open");
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
    if (seen.openness) tell_openness(*seen.openness, std::move(seen.filled), cleaned, log);
    return std::move(cleaned.mesh);
}

} // namespace vcarve

#include "steps/6_surface/carve_surface.h"

#include "base/parallel.h"
#include "mesh/half_edge_mesh.h"
#include "mesh/vertices.h"
#include "model/colors.h"
#include "model/scene_points.h"
#include "steps/3_cells/limits.h"
#include "steps/4_visibility/face_visibility.h"
#include "steps/5_labels/boundary.h"
#include "steps/6_surface/face_rules.h"
#include "steps/6_surface/trim.h"

#include <utility>
#include <vector>

namespace vcarve {

namespace {

void require_faces(const CarvedSurface& made)
{
    if (!made.faces.faces.empty()) return;
    if (made.counts.out_of_region > 0) {
        throw NoSurface("the region of --crop contains no face of the surface; enlarge it");
    }
    throw NoSurface("no surface found: too few rays pass behind the points; add images, or dense "
                    "points");
}

} // namespace

void Removals::note(const FaceFlags& keep, Removal reason)
{
    if (wanted_ == nullptr) return;
    why_.resize(keep.size(), kKept);
    for (std::size_t face = 0; face < keep.size(); ++face) {
        if (keep[face] != 0) why_[face] = kKept;
        if (keep[face] == 0 && why_[face] == kKept) why_[face] = static_cast<std::uint8_t>(reason);
    }
}

void Removals::add_noted(const TriMesh& boundary)
{
    if (wanted_ == nullptr) return;
    std::vector<Face> faces;
    for (std::size_t face = 0; face < why_.size(); ++face) {
        if (why_[face] == kKept) continue;
        faces.push_back(boundary.faces[face]);
        wanted_->reasons.push_back(static_cast<Removal>(why_[face]));
    }
    const std::vector<std::uint32_t> vertices = used_vertices(faces, boundary.positions.size());
    renumber(faces, vertices, boundary.positions.size());
    wanted_->mesh.offset = boundary.offset;
    wanted_->mesh.positions = values_at(vertices, boundary.positions);
    wanted_->mesh.faces = std::move(faces);
}

void Removals::add_deleted(const HalfEdgeMesh& mesh, std::size_t end)
{
    if (wanted_ == nullptr) return;
    for (std::size_t i = 0; i < end; ++i) {
        const auto face = handle_at<OpenMesh::FaceHandle>(i);
        if (!mesh.is_deleted(face)) continue;
        const auto first = static_cast<std::uint32_t>(wanted_->mesh.positions.size());
        for (const Eigen::Vector3d& corner : mesh.triangle(face)) {
            wanted_->mesh.positions.push_back(corner);
        }
        wanted_->mesh.faces.push_back({first, first + 1, first + 2});
        wanted_->reasons.push_back(Removal::small_piece);
    }
}

TriMesh extract_surface(const TetMesh& cells, const Labels& labels, const Scene& scene)
{
    return extract_surface(cells, boundary_facets(cells, labels), scene);
}

TriMesh extract_surface(const TetMesh& cells, const std::vector<CellFacet>& facets,
                        const Scene& scene)
{
    TriMesh mesh;
    mesh.offset = scene.offset;
    mesh.faces = boundary_faces(cells, facets);
    mesh.points = used_vertices(mesh.faces, cells.positions.size());
    mesh.positions.resize(mesh.points.size());
    parallel_for(mesh.points.size(), [&](std::size_t vertex) {
        mesh.positions[vertex] = cells.positions[mesh.points[vertex]];
    });
    if (has_colors(scene)) mesh.colors = values_at(mesh.points, scene.colors);
    renumber(mesh.faces, mesh.points, cells.positions.size());
    return mesh;
}

CarvedSurface carve_surface(Labels labels, const SurfaceInput& input, const SurfaceOptions& options,
                            const Progress& progress)
{
    const auto& [cells, scene, region, wants_removed, usual, measures_openness] = input;
    CarvedSurface made;
    Removals removals(wants_removed ? &made.removed : nullptr);
    if (options.closed) close_hull(cells, labels);
    const std::vector<CellFacet> facets = boundary_facets(cells, labels);
    TriMesh surface = extract_surface(cells, facets, scene);
    progress.report(0.2);
    const FaceVisibility visibility(cells, labels, scene);
    progress.report(0.4);
    const Boundary boundary{surface, facets, visibility, usual};
    ChosenFaces chosen = choose_faces(boundary, region, options, removals);
    progress.report(0.7);
    made.counts = {
        .unseen = chosen.unseen, .closing = chosen.closing, .out_of_region = chosen.out_of_region};
    // Neither faces outside a region nor trimmed pieces, which no view sees, count as open.
    if (!options.closed && region == nullptr && measures_openness) {
        made.openness = measure_openness(cells, labels, facets, chosen.keep, scene);
    }
    if (!options.closed) {
        made.counts.trimmed = trim_faces(surface, boundary, options.rules, chosen);
        removals.note(chosen.keep, Removal::trimmed);
    }
    removals.add_noted(surface);
    made.faces = with_faces(std::move(surface), chosen.keep);
    require_faces(made);
    return made;
}

} // namespace vcarve

#include "figures/figures.h"
#include "geometry/triangle.h"
#include "steps/4_visibility/count_crossings.h"
#include "steps/4_visibility/trace.h"
#include "steps/4_visibility/virtual_views.h"
#include "steps/4_visibility/walk.h"
#include "steps/5_labels/boundary.h"
#include "steps/5_labels/label_cells.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace vcarve::paper {

namespace {

Json segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
    return {{from.x(), from.y(), from.z()}, {to.x(), to.y(), to.z()}};
}

/// Calls visit(vertex, view) for each ray.
template <typename Visit>
void for_each_ray(const Scene& scene, const Visit& visit)
{
    for (Index vertex = 0; vertex < scene.num_points(); ++vertex) {
        for (const std::uint32_t view : scene.tracks[vertex]) {
            visit(vertex, view);
        }
    }
}

/// The cells that a ray passes through, beginning at its point.
std::vector<Index> cells_along(const TetMesh& cells, Index vertex, const Eigen::Vector3d& target)
{
    std::vector<Index> passed;
    RayWalk(cells, vertex).to(target, [&](Index cell, int slot) {
        passed.push_back(cell);
        passed.push_back(cells.cells[cell].neighbors[slot]);
    });
    return passed;
}

} // namespace

// ---- figure 13 ----------------------------------------------------------------------------------

namespace {

/// Facets between two carved cells that no ray crosses.
std::vector<CellFacet> unmet_facets(const TetMesh& cells, const Crossings& crossings,
                                    const Labels& labels)
{
    std::vector<CellFacet> unmet;
    for (Index cell = 0; cell < labels.size(); ++cell) {
        for (int slot = 0; slot < 4; ++slot) {
            const Index beyond = cells.cells[cell].neighbors[slot];
            const bool is_finite =
                !cells.cells[cell].is_infinite() && !cells.cells[beyond].is_infinite();
            const bool is_carved =
                labels[cell] == Label::outside && labels[beyond] == Label::outside;
            if (cell < beyond && is_finite && is_carved && crossings[cell][slot] == 0) {
                unmet.push_back({cell, slot});
            }
        }
    }
    return unmet;
}

/// The rays that pass through a cell.
Json rays_through(const TetMesh& cells, const Scene& scene, Index cell)
{
    Json rays = Json::array();
    for_each_ray(scene, [&](Index vertex, std::uint32_t view) {
        const Eigen::Vector3d& center = scene.views[view].center;
        if (std::ranges::count(cells_along(cells, vertex, center), cell) > 0) {
            rays.push_back(segment(cells.positions[vertex], center));
        }
    });
    return rays;
}

} // namespace

Json unmet_triangles(const PaperCase& paper_case)
{
    const TetMesh& cells = paper_case.cells;
    const Scene two = seen_by(paper_case.scene, views_that_open_most(paper_case, 2));
    const Crossings crossings = crossings_of(cells, two);
    const Labels labels = carve(cells, crossings, 1);
    const std::vector<CellFacet> unmet = unmet_facets(cells, crossings, labels);
    const CellFacet largest = *std::ranges::max_element(unmet, {}, [&](const CellFacet& facet) {
        return face_area(cells.positions, face_of(cells, facet));
    });
    std::vector<DrawnFacet> drawn = judged_boundary(paper_case, labels);
    const std::vector<DrawnFacet> surface = drawn;
    for (const CellFacet& facet : unmet) {
        drawn.push_back({facet, "unmet"});
    }
    std::vector<DrawnFacet> pair;
    for (const CellFacet& side : {largest, cells.other_side(largest)}) {
        for (int slot = 0; slot < 4; ++slot) {
            if (slot != side.slot) pair.push_back({{side.cell, slot}, "cell"});
        }
    }
    pair.push_back({largest, "unmet"});
    return {{"object", paper_case.name},
            {"views", 2},
            {"rays", two.num_rays()},
            {"unmet", unmet.size()},
            {"left", mistakes_of(paper_case, labels).kept},
            {"triangles", panel(cells, drawn)},
            {"tetrahedra", panel(cells, surface)},
            {"pair", panel(cells, pair)},
            {"pair_rays",
             {rays_through(cells, two, largest.cell),
              rays_through(cells, two, cells.other_side(largest).cell)}}};
}

// ---- artificial viewpoints ----------------------------------------------------------------------

namespace {

constexpr int kVirtualViews = 20;

/// The labels with two views, and with virtual views added.
struct BeforeAfter {
    Labels before;
    Labels after;
    VirtualRays rays;
};

BeforeAfter look_twice(const PaperCase& paper_case, std::uint32_t a, std::uint32_t b)
{
    const TetMesh& cells = paper_case.cells;
    const VirtualViewOptions options{.count = kVirtualViews};
    const Scene two = seen_by(paper_case.scene, {a, b});
    Crossings crossings = crossings_of(cells, two);
    BeforeAfter made;
    made.before = carve(cells, crossings, 1);
    made.rays = find_virtual_rays(cells, two, made.before, options, {});
    CrossingCounter(cells).cast(made.rays.source(options.weight), crossings, {});
    made.after = carve(cells, crossings, 1);
    return made;
}

} // namespace

Json virtual_viewpoints(const PaperCase& paper_case)
{
    std::size_t pairs = 0;
    std::size_t wrong = 0;
    std::size_t mended = 0;
    std::pair<double, std::optional<BeforeAfter>> best{0.0, std::nullopt};
    for (std::uint32_t a = 0; a < paper_case.scene.views.size(); ++a) {
        for (std::uint32_t b = 0; b < a; ++b) {
            BeforeAfter made = look_twice(paper_case, a, b);
            const Mistakes left = mistakes_of(paper_case, made.before);
            const Mistakes still = mistakes_of(paper_case, made.after);
            ++pairs;
            wrong += left.kept > 0 ? 1 : 0;
            const bool is_mended = left.kept > 0 && still.kept == 0 && still.lost == 0;
            mended += is_mended ? 1 : 0;
            if (is_mended && left.kept_volume > best.first) {
                best = {left.kept_volume, std::move(made)};
            }
        }
    }
    const BeforeAfter& shown = best.second.value();
    const Mistakes left = mistakes_of(paper_case, shown.before);
    return {{"object", paper_case.name},
            {"pairs", pairs},
            {"wrong", wrong},
            {"mended", mended},
            {"virtual_views", kVirtualViews},
            {"virtual_rays", shown.rays.tracks.views.size()},
            {"left", left.kept},
            {"left_volume", left.kept_volume},
            {"still_left", mistakes_of(paper_case, shown.after).kept},
            {"before", panel(paper_case.cells, judged_boundary(paper_case, shown.before))},
            {"after", panel(paper_case.cells, judged_boundary(paper_case, shown.after))}};
}

// ---- a wrong ray ------------------------------------------------------------------------------

namespace {

Scene with_ray(const Scene& scene, Index vertex, std::uint32_t view)
{
    Scene result = scene;
    result.tracks = {};
    for (Index point = 0; point < scene.num_points(); ++point) {
        std::vector<std::uint32_t> row(scene.tracks[point].begin(), scene.tracks[point].end());
        if (point == vertex) row.insert(std::ranges::lower_bound(row, view), view);
        result.tracks.push_back(row);
    }
    return result;
}

Labels cut_of(const TetMesh& cells, const Scene& scene)
{
    const LabelOptions options;
    VisibilityEnergy energy;
    RayCaster(cells, scene, measure_scales(cells, scene), options.trace)
        .cast(photographs(scene), energy, {});
    Labels labels = cut_cells(cells, scene, std::move(energy), options, {}).labels;
    close_hull(cells, labels);
    return labels;
}

Json drilled_panel(const PaperCase& paper_case, const Labels& labels)
{
    const Mistakes found = mistakes_of(paper_case, labels);
    return {{"lost", found.lost},
            {"kept", found.kept},
            {"panel", panel(paper_case.cells, judged_boundary(paper_case, labels))}};
}

} // namespace

Json drilled(const PaperCase& paper_case)
{
    const Scene& scene = paper_case.scene;
    const TetMesh& cells = paper_case.cells;
    std::pair<std::ptrdiff_t, std::pair<Index, std::uint32_t>> most{0, {0, 0}};
    for (Index vertex = 0; vertex < scene.num_points(); ++vertex) {
        for (std::uint32_t view = 0; view < scene.views.size(); ++view) {
            if (std::ranges::count(scene.tracks[vertex], view) > 0) continue;
            const auto passed = cells_along(cells, vertex, scene.views[view].center);
            const bool is_in_solid = std::ranges::all_of(passed, [&](Index cell) {
                return paper_case.truth[cell] == Label::inside || cells.cells[cell].is_infinite();
            });
            if (is_in_solid) most = std::max(most, {std::ssize(passed), {vertex, view}});
        }
    }
    const auto [vertex, view] = most.second;
    const Scene wrong = with_ray(scene, vertex, view);
    return {{"object", paper_case.name},
            {"rays", scene.num_rays()},
            {"truth", panel(cells, judged_boundary(paper_case, paper_case.truth))},
            {"line", segment(cells.positions[vertex], scene.views[view].center)},
            {"strict", drilled_panel(paper_case, carve(cells, crossings_of(cells, wrong), 1))},
            {"cut", drilled_panel(paper_case, cut_of(cells, wrong))},
            {"cut_without", mistakes_of(paper_case, cut_of(cells, scene)).lost}};
}

} // namespace vcarve::paper

#include "steps/5_labels/freed_pieces.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "steps/4_visibility/exact_walk.h"
#include "steps/4_visibility/face_evidence.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr double kNeverPays = -std::numeric_limits<double>::infinity();

/// Few are: most runs of cells are seen to be the same at one glance.
std::vector<Index> freed_cells(const Labels& before, const Labels& after)
{
    constexpr std::size_t kRun = 256;
    const std::size_t num_runs = (before.size() + kRun - 1) / kRun;
    const auto look = [&](std::size_t run, std::vector<Index>& freed) {
        const std::size_t begin = run * kRun;
        const std::size_t end = std::min(before.size(), begin + kRun);
        if (std::memcmp(&before[begin], &after[begin], end - begin) == 0) return;
        for (std::size_t cell = begin; cell < end; ++cell) {
            if (before[cell] == Label::inside && after[cell] == Label::outside)
                freed.push_back(static_cast<Index>(cell));
        }
    };
    return parallel_collect<Index>(num_runs, look, 1024);
}

/// The views that saw one of the corners at least, ascending.
std::vector<std::uint32_t> views_of(const Scene& scene, const Face& corners)
{
    std::vector<std::uint32_t> views;
    for (const std::uint32_t corner : corners) {
        const auto track = scene.tracks[corner];
        views.insert(views.end(), track.begin(), track.end());
    }
    std::ranges::sort(views);
    views.erase(std::unique(views.begin(), views.end()), views.end());
    return views;
}

} // namespace

double plausibility(const Boundary& boundary, std::size_t face)
{
    constexpr double kGoesOn = 0.8; // cosine, about 37 degrees
    constexpr double kNotKnown = -1.0;
    const auto cosines = boundary.normals().cosines(face, kNotKnown);
    const double size = boundary.edges().relative_size(face);
    double chance = 0.75 / (1.0 + size / 6.0); // goes on with the surface at one corner at most
    if (cosines[1] >= kGoesOn)
        chance = 1.0 / (1.0 + size * size / 144.0);
    else if (cosines[2] >= kGoesOn)
        chance = 0.85 / (1.0 + size * size / 225.0);
    return chance >= 0.0 ? chance : 0.0; // 0 where the size is not known
}

FreedPieces::FreedPieces(const TetMesh& cells, const Scene& scene, const Labels& before,
                         const Labels& after)
    : cells_(cells),
      scene_(scene),
      before_(before),
      after_(after),
      freed_(freed_cells(before, after)),
      pieces_(freed_.size()),
      saw_(cells, before, scene),
      sees_(cells, after, scene),
      gains_(freed_.size(), 0.0)
{
    parallel_for(freed_.size(), [&](std::size_t i) {
        for (const Index neighbor : cells.cells[freed_[i]].neighbors) {
            const bool is_freed =
                before[neighbor] == Label::inside && after[neighbor] == Label::outside;
            if (is_freed) pieces_.join(static_cast<std::uint32_t>(i), number_of(neighbor));
        }
    });
}

/// Where a freed cell stands among them.
std::uint32_t FreedPieces::number_of(Index cell) const
{
    return static_cast<std::uint32_t>(std::ranges::lower_bound(freed_, cell) - freed_.begin());
}

/// What the views that saw a face see in its stead.
std::vector<FreedPieces::Outlook> FreedPieces::outlooks_from(const Boundary& boundary_before,
                                                             std::size_t face) const
{
    constexpr std::ptrdiff_t kPlaces = 4; // its middle and near its corners
    const CellFacet& facet = boundary_before.facets()[face];
    const std::vector<Vector3d> places = saw_.places_on(facet);
    std::vector<Outlook> outlooks;
    for (const std::uint32_t view : views_of(scene_, boundary_before.faces()[face])) {
        for (const Vector3d& place : std::span(places).first(kPlaces)) {
            if (!saw_.sees(view, facet, place)) continue;
            outlooks.push_back(
                {.freed = number_of(facet.cell), .met = sees_.met_beyond(view, facet, place)});
        }
    }
    const double area = face_area(cells_.positions, boundary_before.faces()[face]);
    for (Outlook& outlook : outlooks) {
        outlook.area = area / static_cast<double>(outlooks.size());
        outlook.taken = outlook.area * plausibility(boundary_before, face);
    }
    return outlooks;
}

/// Whether a corner of a freed cell is on no face any more: all cells there are outside. Of most
/// corners the cell behind some face before tells that it is not so.
bool FreedPieces::loses_a_point(Index cell, const Boundary& boundary_before) const
{
    const auto is_outside = [&](Index around) { return after_[around] == Label::outside; };
    const auto behind = [&](std::uint32_t face) { return boundary_before.facets()[face].cell; };
    return std::ranges::any_of(cells_.cells[cell].vertices, [&](Index vertex) {
        if (vertex == kInfinite) return false;
        const auto faces = boundary_before.edges().faces_at()[vertex];
        return std::ranges::all_of(faces, is_outside, behind) &&
               std::ranges::all_of(cells_around_vertex(cells_, vertex, cell), is_outside);
    });
}

/// Finds the pieces that never pay, since they leave a point on no face.
void FreedPieces::find_losers(const Boundary& boundary_before)
{
    std::vector<std::uint8_t> loses(freed_.size());
    const auto look = [&](std::size_t i) {
        loses[i] = loses_a_point(freed_[i], boundary_before) ? 1 : 0;
    };
    parallel_for(loses.size(), look, 64);
    for (std::uint32_t i = 0; i < loses.size(); ++i) {
        if (loses[i] != 0) gains_[pieces_.root(i)] = kNeverPays;
    }
}

/// The facets that the pieces which may pay took from the boundary before, ascending.
std::vector<CellFacet> FreedPieces::taken_facets()
{
    std::vector<CellFacet> taken;
    for (std::uint32_t i = 0; i < freed_.size(); ++i) {
        if (gains_[pieces_.root(i)] == kNeverPays) continue;
        for (int slot = 0; slot < 4; ++slot) {
            if (before_[cells_.cells[freed_[i]].neighbors[slot]] == Label::outside)
                taken.push_back({freed_[i], slot});
        }
    }
    return taken;
}

void FreedPieces::take_away(const Boundary& boundary_before)
{
    constexpr double kAtLeast = 0.9; // of what it takes away a piece must show
    find_losers(boundary_before);
    const std::vector<CellFacet> taken = taken_facets();
    const auto look = [&](std::size_t i, std::vector<Outlook>& found) {
        std::ranges::copy(outlooks_from(boundary_before, boundary_before.number_of(taken[i])),
                          std::back_inserter(found));
    };
    outlooks_ = parallel_collect<Outlook>(taken.size(), look, 16);
    for (const Outlook& outlook : outlooks_) {
        gains_[pieces_.root(outlook.freed)] -= kAtLeast * outlook.taken;
    }
}

/// How good it is to see something, from -0.5 to 1.
double FreedPieces::worth(const Boundary& boundary_after, const FaceVisibility::Crossed& met) const
{
    constexpr double kNothing = 0.3;
    constexpr double kBack = -0.5;
    constexpr double kDoubtful = 0.5;
    if (met.side == FaceVisibility::Meets::nothing) return kNothing;
    if (met.side == FaceVisibility::Meets::back) return kBack;
    const std::size_t face = boundary_after.number_of(met.facet);
    const Face& corners = boundary_after.faces()[face];
    const Vector3d normal = boundary_after.normals().of(face);
    if (is_seen(scene_, corners, normal)) return plausibility(boundary_after, face);
    if (is_seen(scene_, corners, -normal)) return kBack;
    return kDoubtful * plausibility(boundary_after, face);
}

void FreedPieces::lay_open(const Boundary& boundary_after)
{
    std::vector<double> shown(outlooks_.size());
    parallel_for(
        shown.size(),
        [&](std::size_t i) {
            shown[i] = outlooks_[i].area * worth(boundary_after, outlooks_[i].met);
        },
        64);
    for (std::size_t i = 0; i < shown.size(); ++i) {
        gains_[pieces_.root(outlooks_[i].freed)] += shown[i];
    }
}

std::vector<Index> FreedPieces::unpaid()
{
    std::vector<Index> unpaid;
    for (std::uint32_t i = 0; i < freed_.size(); ++i) {
        if (gains_[pieces_.root(i)] < 0.0) unpaid.push_back(freed_[i]);
    }
    return unpaid;
}

} // namespace vcarve

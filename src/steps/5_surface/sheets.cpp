#include "steps/5_surface/sheets.h"

#include "base/parallel.h"
#include "mesh/local_edges.h"
#include "mesh/surface_normals.h"
#include "steps/1_points/looked_at_ball.h"
#include "steps/4_labels/boundary.h"

#include <algorithm>

namespace vcarve {

namespace {

/// Whether a facet is kept, for facets in ascending order.
class KeptFacets {
  public:
    KeptFacets(const std::vector<CellFacet>& facets, const FaceFlags& keep)
        : facets_(facets), keep_(keep)
    {
    }

    bool operator()(const CellFacet& facet) const { return keep_[place_of(facet, facets_)] != 0; }

  private:
    const std::vector<CellFacet>& facets_;
    const FaceFlags& keep_;
};

/// All views, and what there is of the boundary for them to see.
struct Onlookers {
    const FaceVisibility& visibility;
    const KeptFacets& is_kept;

    /// Whether for one of those that see a place ask(view) says yes.
    template <typename Ask>
    bool any_that_sees(const CellFacet& facet, const Eigen::Vector3d& place, const Ask& ask) const
    {
        const std::size_t num_views = visibility.scene().views.size();
        for (std::uint32_t view = 0; view < num_views; ++view) {
            if (visibility.sees_among(view, facet, place, is_kept) && ask(view)) return true;
        }
        return false;
    }

    bool see(const CellFacet& facet, const Eigen::Vector3d& place) const
    {
        return any_that_sees(facet, place, [](std::uint32_t) { return true; });
    }

    /// Whether one of them would look onto the back of a kept face, were this one away.
    bool would_see_a_back(const CellFacet& facet, const Eigen::Vector3d& place) const
    {
        return any_that_sees(facet, place, [&](std::uint32_t view) {
            return visibility.met_behind(view, facet, place, is_kept) ==
                   FaceVisibility::Meets::back;
        });
    }
};

bool hides_a_back(const CellFacet& facet, const Onlookers& onlookers)
{
    return std::ranges::any_of(onlookers.visibility.places_on(facet), [&](const auto& place) {
        return onlookers.would_see_a_back(facet, place);
    });
}

/// Whether no view sees half of the places on a facet or more.
bool is_mostly_unseen(const CellFacet& facet, const Onlookers& onlookers)
{
    const std::vector<Eigen::Vector3d> places = onlookers.visibility.places_on(facet);
    const auto num_seen = std::ranges::count_if(
        places, [&](const auto& place) { return onlookers.see(facet, place); });
    return 2 * static_cast<std::size_t>(num_seen) < places.size();
}

/// Whether a face goes on with the surface at one of its corners.
bool goes_on(std::size_t face, const SurfaceNormals& normals)
{
    constexpr double kGoesOn = 0.9; // cosine, about 26 degrees
    constexpr double kNotKnown = -1.0;
    return normals.cosines(face, kNotKnown)[2] >= kGoesOn;
}

/// Whether a face has an edge at which another one is not kept.
bool is_at_rim(std::uint32_t face, const std::vector<Face>& faces, const VertexFaces& faces_at,
               const FaceFlags& keep)
{
    const auto is_gone_at = [&](std::uint32_t from, std::uint32_t to) {
        return std::ranges::any_of(faces_at[from], [&](std::uint32_t other) {
            return keep[other] == 0 && std::ranges::count(faces[other], to) > 0;
        });
    };
    const auto& [a, b, c] = faces[face];
    return is_gone_at(a, b) || is_gone_at(b, c) || is_gone_at(c, a);
}

/// The kept faces with an edge so long, ascending.
std::vector<std::uint32_t> faces_with_long_edges(const TriMesh& boundary, const FaceFlags& keep,
                                                 double longest)
{
    const auto is_long = [&](std::uint32_t from, std::uint32_t to) {
        return (boundary.positions[to] - boundary.positions[from]).norm() >= longest;
    };
    return parallel_collect<std::uint32_t>(keep.size(), [&](std::size_t i, auto& large) {
        const auto& [a, b, c] = boundary.faces[i];
        if (keep[i] == 0) return;
        if (is_long(a, b) || is_long(b, c) || is_long(c, a)) {
            large.push_back(static_cast<std::uint32_t>(i));
        }
    });
}

/// Of some faces those that a question is answered with yes for.
template <typename Ask>
std::vector<std::uint32_t> those_that(const std::vector<std::uint32_t>& faces, const Ask& ask)
{
    return parallel_collect<std::uint32_t>(
        faces.size(),
        [&](std::size_t i, auto& found) {
            if (ask(faces[i])) found.push_back(faces[i]);
        },
        16);
}

} // namespace

std::int64_t peel_sheets(const TriMesh& boundary, const std::vector<CellFacet>& facets,
                         const FaceVisibility& visibility, const SheetOptions& options,
                         FaceFlags& keep)
{
    constexpr int kRounds = 20;
    if (options.max_sheet == 0.0) return 0;
    const double long_edge = options.max_sheet * 2.0 * looked_at_ball(visibility.scene()).radius;
    const std::vector<std::uint32_t> large = faces_with_long_edges(boundary, keep, long_edge);
    if (large.empty()) return 0;
    const VertexFaces faces_at(boundary.faces, boundary.positions.size());
    const KeptFacets is_kept(facets, keep);
    const Onlookers onlookers{visibility, is_kept};
    std::int64_t peeled = 0;
    for (int round = 0; round < kRounds; ++round) {
        const LocalEdges edges(boundary.positions, boundary.faces, keep);
        const SurfaceNormals normals(boundary.positions, boundary.faces, edges);
        const auto is_sheet = [&](std::uint32_t face) {
            const CellFacet& facet = facets[face];
            if (keep[face] == 0) return false;
            if (!visibility.is_on_hull(facet) && !is_at_rim(face, boundary.faces, faces_at, keep))
                return false;
            return (!goes_on(face, normals) || is_mostly_unseen(facet, onlookers)) &&
                   !hides_a_back(facet, onlookers);
        };
        const std::vector<std::uint32_t> sheets = those_that(large, is_sheet);
        for (const std::uint32_t face : sheets) {
            keep[face] = 0;
        }
        peeled += static_cast<std::int64_t>(sheets.size());
        if (sheets.empty()) break;
    }
    return peeled;
}

} // namespace vcarve

#include "steps/6_surface/trim.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/edge_halving.h"
#include "mesh/straight_rims.h"
#include "steps/6_surface/holes_beside.h"
#include "steps/6_surface/onlookers.h"
#include "steps/6_surface/sheets.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// From which share of the length of a sheet on a face is trimmed.
constexpr double kLarge = 0.5;

/// How much views see of a piece.
enum class Seen : std::uint8_t { none, part, all };

/// Trims the faces of a boundary.
class Trimming {
  public:
    Trimming(TriMesh& boundary, const std::vector<CellFacet>& facets,
             const FaceVisibility& visibility, double long_edge, FaceFlags& keep)
        : boundary_(boundary),
          facets_(facets),
          visibility_(visibility),
          long_edge_(long_edge),
          keep_(keep),
          whole_(keep),
          onlookers_(visibility, facets, whole_),
          halving_(boundary, keep),
          first_middle_(static_cast<std::uint32_t>(boundary.positions.size())),
          origins_(keep.size() - facets.size(), kNoOrigin)
    {
    }

    /// Takes the flags off the pieces of faces that no view sees, and divides no more than that
    /// asks for. Returns how many faces lost a piece.
    std::int64_t trim(std::vector<std::uint32_t> faces);

  private:
    static constexpr std::uint32_t kNoOrigin = kNoPlane; ///< of what fills holes

    std::array<Vector3d, 3> corners_of(std::uint32_t face) const
    {
        return vcarve::corners_of(boundary_.positions, boundary_.faces[face]);
    }
    /// The face of the boundary that a face is, or is a piece of.
    std::uint32_t origin_of(std::uint32_t face) const
    {
        return face < facets_.size() ? face : origins_[face - facets_.size()];
    }

    std::vector<Vector3d> places_on(std::uint32_t piece) const;
    Seen seen_of(std::uint32_t piece) const;
    bool is_short(std::uint32_t piece) const;
    std::vector<std::uint32_t> halve(const std::vector<std::uint32_t>& pieces);
    void join_pieces();

    TriMesh& boundary_;
    const std::vector<CellFacet>& facets_;
    const FaceVisibility& visibility_;
    double long_edge_;
    FaceFlags& keep_;
    const FaceFlags whole_; ///< what was kept before, which hides what is behind it
    Onlookers onlookers_;
    EdgeHalving halving_;
    std::uint32_t first_middle_;         ///< of the vertices that halving adds
    std::vector<std::uint32_t> origins_; ///< of the faces that were added
};

/// Where a piece is looked at: more closely where it is large, since more of it could go unseen.
std::vector<Vector3d> Trimming::places_on(std::uint32_t piece) const
{
    constexpr int kToASide = 4;
    const std::array<Vector3d, 3> corners = corners_of(piece);
    std::vector<Vector3d> places = vcarve::places_on(corners);
    if (longest_edge(corners) < kLarge * long_edge_) return places;
    const std::vector<Vector3d> more = grid_on(corners, kToASide);
    places.insert(places.end(), more.begin(), more.end());
    return places;
}

Seen Trimming::seen_of(std::uint32_t piece) const
{
    const CellFacet& facet = facets_[origin_of(piece)];
    const std::vector<Vector3d> places = places_on(piece);
    const auto is_seen = [&](const Vector3d& place) {
        return onlookers_.see_or_graze(facet, place);
    };
    const bool first = is_seen(places[0]);
    const bool is_same_everywhere =
        std::ranges::all_of(places.begin() + 1, places.end(),
                            [&](const Vector3d& place) { return is_seen(place) == first; });
    if (!is_same_everywhere) return Seen::part;
    return first ? Seen::all : Seen::none;
}

/// Whether a piece is not worth halving.
bool Trimming::is_short(std::uint32_t piece) const
{
    constexpr double kShort = 0.25;
    constexpr double kSmallPart = 0.07; // of the longest edge of the whole face; no power of 1/2
    const double whole = longest_edge(visibility_.corners_of(facets_[origin_of(piece)]));
    return longest_edge(corners_of(piece)) <= std::max(kShort * long_edge_, kSmallPart * whole);
}

/// Halves pieces at their longest edges, and whatever else is at these. Returns the halves of the
/// pieces, ascending.
std::vector<std::uint32_t> Trimming::halve(const std::vector<std::uint32_t>& pieces)
{
    std::set<std::uint32_t> whole(pieces.begin(), pieces.end());
    std::set<std::uint32_t> halves;
    for (const std::uint32_t piece : pieces) {
        if (!whole.contains(piece)) continue; // halved along with another
        const auto [a, b] = longest_edge_of(boundary_.positions, boundary_.faces[piece]);
        for (const auto& [face, other_half] : halving_.halve(a, b)) {
            keep_.push_back(std::uint8_t(keep_[face]));
            origins_.push_back(origin_of(face));
            if (whole.erase(face) > 0 || halves.contains(face)) halves.insert({face, other_half});
        }
    }
    return {halves.begin(), halves.end()};
}

/// Joins halves again that are both kept or both not, and takes vertices out of straight rims.
void Trimming::join_pieces()
{
    const auto joined = halving_.take_back(
        [&](std::uint32_t face, std::uint32_t other) { return keep_[face] == keep_[other]; });
    FaceFlags is_gone(boundary_.faces.size(), 0);
    for (const std::uint32_t face : joined) {
        is_gone[face] = 1;
        keep_[face] = 0;
    }
    const auto plane_of = [&](std::uint32_t face) { return origin_of(face); };
    const auto first_face = static_cast<std::uint32_t>(facets_.size());
    for (const std::uint32_t face :
         straighten_rims(first_middle_, first_face, plane_of, boundary_, keep_)) {
        is_gone[face] = 1;
    }
    std::size_t left = facets_.size(); // none of the faces before was added
    for (std::size_t face = left; face < boundary_.faces.size(); ++face) {
        if (is_gone[face] != 0) continue;
        boundary_.faces[left] = boundary_.faces[face];
        keep_[left] = keep_[face];
        origins_[left - facets_.size()] = origins_[face - facets_.size()];
        ++left;
    }
    boundary_.faces.resize(left);
    keep_.resize(left);
    origins_.resize(left - facets_.size());
}

std::int64_t Trimming::trim(std::vector<std::uint32_t> faces)
{
    for (std::vector<std::uint32_t>& pieces = faces; !pieces.empty();) {
        std::vector<Seen> seen(pieces.size());
        parallel_for(
            pieces.size(), [&](std::size_t i) { seen[i] = seen_of(pieces[i]); }, 4);
        std::vector<std::uint32_t> mixed;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            if (seen[i] == Seen::none) keep_[pieces[i]] = 0;
            if (seen[i] == Seen::part && !is_short(pieces[i])) mixed.push_back(pieces[i]);
        }
        pieces = halve(mixed);
    }
    join_pieces();
    std::set<std::uint32_t> trimmed; // what fills holes stays
    for (std::uint32_t face = 0; face < keep_.size(); ++face) {
        if (keep_[face] == 0 && whole_[origin_of(face)] != 0) trimmed.insert(origin_of(face));
    }
    return static_cast<std::int64_t>(trimmed.size());
}

/// The corners of the faces from a number on.
std::vector<std::array<Vector3d, 3>> triangles_from(std::size_t first, const TriMesh& mesh)
{
    std::vector<std::array<Vector3d, 3>> triangles;
    for (std::size_t face = first; face < mesh.faces.size(); ++face) {
        triangles.push_back(corners_of(mesh.positions, mesh.faces[face]));
    }
    return triangles;
}

} // namespace

TrimmedFaces trim_faces(TriMesh& boundary, const std::vector<CellFacet>& facets,
                        const FaceVisibility& visibility, const TrimRules& rules, FaceFlags& keep)
{
    TrimmedFaces trimmed;
    if (rules.options.sheets.max_sheet == 0.0) return trimmed;
    const double long_edge = sheet_edge(visibility.scene(), rules.options.sheets);
    auto large = parallel_collect<std::uint32_t>(keep.size(), [&](std::size_t face, auto& found) {
        if (keep[face] == 0 || rules.unseen[face] != 0) return;
        if (longest_edge(boundary.positions, boundary.faces[face]) < kLarge * long_edge) return;
        found.push_back(static_cast<std::uint32_t>(face));
    });
    std::erase_if(large,
                  [&](std::uint32_t face) { return !visibility.is_told_by_images(facets[face]); });
    if (large.empty()) return trimmed;
    fill_holes_beside(large, rules.options.cleanup.max_hole_edges, boundary, keep);
    trimmed.filled = triangles_from(facets.size(), boundary);
    trimmed.count = Trimming(boundary, facets, visibility, long_edge, keep).trim(std::move(large));
    return trimmed;
}

} // namespace vcarve

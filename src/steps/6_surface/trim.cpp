#include "steps/6_surface/trim.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/edge_halving.h"
#include "steps/6_surface/face_evidence.h"
#include "steps/6_surface/face_rules.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// The visible share of the samples of a piece.
enum class Seen : std::uint8_t { none, part, all };

/// Trims the faces of a boundary.
class Trimming {
  public:
    Trimming(TriMesh& surface, const std::vector<CellFacet>& facets,
             const FaceVisibility& visibility, double long_edge, FaceFlags& keep)
        : surface_(surface),
          boundary_{surface, facets, visibility},
          facets_(facets),
          long_edge_(long_edge),
          keep_(keep),
          whole_(keep),
          halving_(surface, keep)
    {
    }

    /// Clears the flags of pieces that no view sees, and bisects only as far as needed. Returns the
    /// number of faces that lost a piece.
    std::int64_t trim(std::vector<std::uint32_t> faces);

  private:
    std::array<Vector3d, 3> corners_of(std::uint32_t face) const
    {
        return vcarve::corners_of(surface_.positions, surface_.faces[face]);
    }
    /// The original face of a piece, which may be the face itself.
    std::uint32_t origin_of(std::uint32_t face) const
    {
        return face < facets_.size() ? face : origins_[face - facets_.size()];
    }

    Seen seen_of(std::uint32_t piece) const;
    bool is_short(std::uint32_t piece) const;
    std::vector<std::uint32_t> halve(const std::vector<std::uint32_t>& pieces);
    void join_pieces();

    TriMesh& surface_;
    Boundary boundary_;
    const std::vector<CellFacet>& facets_;
    double long_edge_; ///< faces with such an edge are trimmed
    FaceFlags& keep_;
    const FaceFlags whole_; ///< the faces kept before, which block views
    EdgeHalving halving_;
    std::vector<std::uint32_t> origins_; ///< original faces of the added pieces
};

Seen Trimming::seen_of(std::uint32_t piece) const
{
    const CellFacet& facet = facets_[origin_of(piece)];
    const std::vector<Vector3d> places = places_on(corners_of(piece));
    const auto is_seen = [&](const Vector3d& place) {
        return vcarve::is_seen(boundary_, whole_, facet, place, 0.0);
    };
    const bool first = is_seen(places[0]);
    const bool is_same_everywhere =
        std::ranges::all_of(places.begin() + 1, places.end(),
                            [&](const Vector3d& place) { return is_seen(place) == first; });
    if (!is_same_everywhere) return Seen::part;
    return first ? Seen::all : Seen::none;
}

/// Whether a piece is too short to be bisected.
bool Trimming::is_short(std::uint32_t piece) const
{
    constexpr double kShort = 0.5;      // of the length that makes a face be trimmed
    constexpr double kSmallPart = 0.07; // of the original face's longest edge; for a power of 1/2,
                                        // rounding would decide
    const double whole = longest_edge(boundary_.visibility.corners_of(facets_[origin_of(piece)]));
    return longest_edge(corners_of(piece)) <= std::max(kShort * long_edge_, kSmallPart * whole);
}

/// Bisects pieces and their neighbors at the longest edges of the pieces. Returns the halves of the
/// pieces, ascending.
std::vector<std::uint32_t> Trimming::halve(const std::vector<std::uint32_t>& pieces)
{
    std::set<std::uint32_t> whole(pieces.begin(), pieces.end());
    std::set<std::uint32_t> halves;
    for (const std::uint32_t piece : pieces) {
        if (!whole.contains(piece)) continue; // already bisected with another
        const auto [a, b] = longest_edge_of(surface_.positions, surface_.faces[piece]);
        for (const auto& [face, other_half] : halving_.halve(a, b)) {
            keep_.push_back(std::uint8_t(keep_[face]));
            origins_.push_back(origin_of(face));
            if (whole.erase(face) > 0 || halves.contains(face)) halves.insert({face, other_half});
        }
    }
    return {halves.begin(), halves.end()};
}

/// Merges halves that are both kept or both dropped.
void Trimming::join_pieces()
{
    const auto joined = halving_.take_back(
        [&](std::uint32_t face, std::uint32_t other) { return keep_[face] == keep_[other]; });
    FaceFlags is_gone(surface_.faces.size(), 0);
    for (const std::uint32_t face : joined) {
        is_gone[face] = 1;
    }
    std::size_t left = facets_.size(); // no face before this was added
    for (std::size_t face = left; face < surface_.faces.size(); ++face) {
        if (is_gone[face] != 0) continue;
        surface_.faces[left] = surface_.faces[face];
        keep_[left] = keep_[face];
        origins_[left - facets_.size()] = origins_[face - facets_.size()];
        ++left;
    }
    surface_.faces.resize(left);
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
    std::set<std::uint32_t> trimmed;
    for (std::uint32_t face = 0; face < keep_.size(); ++face) {
        if (keep_[face] == 0 && whole_[origin_of(face)] != 0) trimmed.insert(origin_of(face));
    }
    return static_cast<std::int64_t>(trimmed.size());
}

} // namespace

std::int64_t trim_faces(TriMesh& surface, const Boundary& boundary, const FaceRules& rules,
                        ChosenFaces& chosen)
{
    const FaceVisibility& visibility = boundary.visibility;
    const double long_edge = rules.trim * closing_length(visibility.scene(), rules, boundary.usual);
    if (!(long_edge > 0.0)) return 0;
    FaceFlags& keep = chosen.keep;
    auto large = parallel_collect<std::uint32_t>(keep.size(), [&](std::size_t face, auto& found) {
        if (keep[face] == 0 || chosen.seen[face] == 0) return;
        if (longest_edge(surface.positions, surface.faces[face]) < long_edge) return;
        if (!visibility.has_reliable_visibility(boundary.facets[face])) return;
        found.push_back(static_cast<std::uint32_t>(face));
    });
    if (large.empty()) return 0;
    return Trimming(surface, boundary.facets, visibility, long_edge, keep).trim(std::move(large));
}

} // namespace vcarve

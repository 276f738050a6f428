#include "steps/6_surface/face_evidence.h"

#include "base/parallel.h"
#include "base/statistics.h"
#include "steps/5_labels/boundary.h"

#include <algorithm>

namespace vcarve {

using Eigen::Vector3d;

namespace {

double median_length(const LocalEdges& edges, const FaceFlags& keep)
{
    auto lengths = parallel_collect<double>(keep.size(), [&](std::size_t face, auto& found) {
        if (keep[face] != 0) found.push_back(edges.longest_edge(face));
    });
    return lengths.empty() ? 0.0 : median_in_place(lengths);
}

/// Whether a facet of a boundary is kept.
struct KeptFacets {
    const Boundary& boundary;
    const FaceFlags& keep;

    bool operator()(const CellFacet& facet) const
    {
        return keep[place_of(facet, boundary.facets)] != 0;
    }
};

} // namespace

bool is_seen(const Boundary& boundary, const FaceFlags& keep, const CellFacet& facet,
             const Vector3d& place, double cosine)
{
    const KeptFacets is_kept{boundary, keep};
    return boundary.visibility.any_view(facet, place, [&](std::uint32_t view) {
        return boundary.visibility.sees_among(view, facet, place, is_kept, cosine);
    });
}

FaceEvidence::FaceEvidence(const Boundary& boundary, const FaceFlags& keep)
    : boundary_(boundary),
      keep_(keep),
      faces_at_(boundary.surface.faces, boundary.surface.positions.size()),
      edges_(boundary.surface.positions, boundary.surface.faces, keep),
      normals_(boundary.surface.positions, boundary.surface.faces, edges_),
      usual_length_(usual_value(boundary.usual, &UsualValues::face_length,
                                [&] { return median_length(edges_, keep); }))
{
}

bool FaceEvidence::is_at_rim(std::uint32_t face) const
{
    return boundary_.visibility.is_on_hull(boundary_.facets[face]) ||
           std::ranges::any_of(kCorners, [&](int corner) {
               bool is_gone = false;
               visit_beside(boundary_.surface.faces, face, corner, faces_at_,
                            [&](std::uint32_t other) { is_gone = is_gone || keep_[other] == 0; });
               return is_gone;
           });
}

bool FaceEvidence::is_beside_kept(std::uint32_t face) const
{
    return std::ranges::any_of(kCorners, [&](int corner) {
        bool is_beside = false;
        visit_beside(boundary_.surface.faces, face, corner, faces_at_,
                     [&](std::uint32_t other) { is_beside = is_beside || keep_[other] != 0; });
        return is_beside;
    });
}

bool FaceEvidence::is_seen_less_than(double share, std::uint32_t face) const
{
    const CellFacet& facet = boundary_.facets[face];
    if (!boundary_.visibility.has_reliable_visibility(facet)) return false;
    const std::vector<Vector3d> places = boundary_.visibility.places_on(facet);
    const double enough = share * static_cast<double>(places.size());
    double seen = 0.0;
    for (const Vector3d& place : places) {
        if (is_seen(boundary_, keep_, facet, place, kGrazing)) seen += 1.0;
        if (seen >= enough) return false;
    }
    return true;
}

bool FaceEvidence::hides_back(std::uint32_t face) const
{
    const CellFacet& facet = boundary_.facets[face];
    const FaceVisibility& visibility = boundary_.visibility;
    const KeptFacets is_kept{boundary_, keep_};
    return std::ranges::any_of(visibility.places_on(facet), [&](const Vector3d& place) {
        return visibility.any_view(facet, place, [&](std::uint32_t view) {
            return visibility.sees_among(view, facet, place, is_kept) &&
                   visibility.met_behind(view, facet, place, is_kept) ==
                       FaceVisibility::Meets::back;
        });
    });
}

} // namespace vcarve

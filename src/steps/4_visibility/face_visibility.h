#pragma once

#include "mesh/vertices.h"
#include "model/tet_mesh.h"
#include "model/view_tree.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace vcarve {

/// Cosine of the angle off the normal up to which a view sees a face by more than a graze: about 87
/// degrees.
inline constexpr double kGrazing = 0.05;

/// Whether a view at `center` stands before a place with this unit normal, so that the cosine of
/// the angle off the normal is above the given one. Never where the normal is zero.
bool stands_before(const Eigen::Vector3d& center, const Eigen::Vector3d& place,
                   const Eigen::Vector3d& normal, double cosine = kGrazing);

/// Places spread over a triangle: its middle, and near its corners and the middles of its edges; on
/// a long thin one also so near its corners as its shortest edge is long. At most 10.
std::vector<Eigen::Vector3d> places_on(const std::array<Eigen::Vector3d, 3>& corners);

/// Places spread evenly over a triangle, so many along each side.
std::vector<Eigen::Vector3d> grid_on(const std::array<Eigen::Vector3d, 3>& corners, int to_a_side);

/// What the views see of the boundary between inside and outside cells. A view sees a place on a
/// boundary facet if its image shows the place, the facet turns its front, the outside, to the
/// view, by more than a graze, and the way between them leads through outside cells only. Facets
/// are given from their inside cells. Safe from many threads. Keeps references.
class FaceVisibility {
  public:
    /// What a line meets.
    enum class Meets { nothing, front, back };

    /// A facet of the boundary, given from its inside cell, and from which side a line meets it.
    struct Crossed {
        CellFacet facet;
        Meets side = Meets::nothing;
    };

    FaceVisibility(const TetMesh& cells, const Labels& labels, const Scene& scene);

    const Scene& scene() const { return scene_; }

    std::array<Eigen::Vector3d, 3> corners_of(const CellFacet& facet) const;

    /// Places spread over a facet, as over any triangle.
    std::vector<Eigen::Vector3d> places_on(const CellFacet& facet) const;

    /// Whether a view sees a place on a facet, at more than a graze.
    /// Cost: a walk through the cells up to the view, where the view stands before the facet and
    /// its image shows the place.
    bool sees(std::uint32_t view, const CellFacet& facet, const Eigen::Vector3d& place) const;

    /// Whether some view sees one of the places on a facet, as any_view() asks them. Cost: up to 32
    /// walks for each place, and one for each view that saw a corner.
    bool is_seen(const CellFacet& facet) const;

    /// The same of a place where of the boundary only the facets are there that is_kept(facet)
    /// names.
    template <typename IsKept>
    bool sees_among(std::uint32_t view, const CellFacet& facet, const Eigen::Vector3d& place,
                    const IsKept& is_kept, double cosine = kGrazing) const;

    /// Whether ask(view) says yes for some view that may see a place on a facet: of those that saw
    /// a corner of it, the likeliest to see it, or of the nearest 32 that stand before it and whose
    /// images show it.
    template <typename Ask>
    bool any_view(const CellFacet& facet, const Eigen::Vector3d& place, const Ask& ask) const;

    /// Whether images tell what is seen of a facet: of the views before a corner that saw it, one
    /// shows it at least. Where a lens or a pose is wrong they do not.
    bool is_told_by_images(const CellFacet& facet) const;

    /// Whether nothing but infinity lies behind a facet.
    bool is_before_infinity(const CellFacet& facet) const
    {
        return cells_.cells[facet.cell].is_infinite();
    }

    /// Whether nothing but infinity lies before a facet.
    bool is_on_hull(const CellFacet& facet) const
    {
        return cells_.cells[cells_.other_side(facet).cell].is_infinite();
    }

    /// What a view that sees a place on a facet would meet, were the facet away: the first facet
    /// behind the place that is_kept(facet) says is there, from its front or from its back.
    template <typename IsKept>
    Meets met_behind(std::uint32_t view, const CellFacet& facet, const Eigen::Vector3d& place,
                     const IsKept& is_kept) const;

  private:
    /// Towards the outside; not of unit length.
    Eigen::Vector3d outward(const CellFacet& facet) const;

    bool faces(std::uint32_t view, const CellFacet& facet, const Eigen::Vector3d& place,
               double cosine = kGrazing) const;

    Crossed crossed_at(const CellFacet& ahead) const;

    bool is_free(const CellFacet& ahead, const CellFacet& facet) const;

    template <typename Ask>
    bool any_view_of_corners(const CellFacet& facet, const Ask& ask) const;
    template <typename Ask>
    bool any_near_view(const CellFacet& facet, const Eigen::Vector3d& place, const Ask& ask) const;

    /// Walks along a line out of a facet's cell, from a place on the facet to a target, and calls
    /// goes_on(crossed) for what it crosses of the boundary behind the facet itself, until that
    /// says no. False where the line does not clearly pass through the facet.
    bool along_boundary(const CellFacet& facet, const Eigen::Vector3d& place,
                        const Eigen::Vector3d& target,
                        const std::function<bool(const Crossed&)>& goes_on) const;

    const TetMesh& cells_;
    const Labels& labels_;
    const Scene& scene_;
    ViewTree views_;
    double reach_ = 0.0; ///< longer than any line within the hull
};

template <typename Ask>
bool FaceVisibility::any_view_of_corners(const CellFacet& facet, const Ask& ask) const
{
    return std::ranges::any_of(kFacetCorners[facet.slot], [&](int corner) {
        return std::ranges::any_of(scene_.tracks[cells_.cells[facet.cell].vertices[corner]], ask);
    });
}

template <typename Ask>
bool FaceVisibility::any_near_view(const CellFacet& facet, const Eigen::Vector3d& place,
                                   const Ask& ask) const
{
    std::size_t asked = 0;
    bool is_yes = false;
    views_.any_from_nearest(place, outward(facet), [&](std::uint32_t view) {
        if (!faces(view, facet, place, 0.0)) return false;
        is_yes = ask(view);
        return is_yes || ++asked == kMostAsked;
    });
    return is_yes;
}

template <typename Ask>
bool FaceVisibility::any_view(const CellFacet& facet, const Eigen::Vector3d& place,
                              const Ask& ask) const
{
    return any_view_of_corners(facet, ask) || any_near_view(facet, place, ask);
}

template <typename IsKept>
bool FaceVisibility::sees_among(std::uint32_t view, const CellFacet& facet,
                                const Eigen::Vector3d& place, const IsKept& is_kept,
                                double cosine) const
{
    if (!faces(view, facet, place, cosine)) return false;
    bool is_free = true;
    const auto goes_on = [&](const Crossed& crossed) {
        is_free = !is_kept(crossed.facet);
        return is_free;
    };
    return along_boundary(facet, place, scene_.views[view].center, goes_on) && is_free;
}

template <typename IsKept>
FaceVisibility::Meets FaceVisibility::met_behind(std::uint32_t view, const CellFacet& facet,
                                                 const Eigen::Vector3d& place,
                                                 const IsKept& is_kept) const
{
    const Eigen::Vector3d way = (place - scene_.views[view].center).normalized();
    Meets met = Meets::nothing;
    along_boundary(cells_.other_side(facet), place, place + reach_ * way,
                   [&](const Crossed& crossed) {
                       if (is_kept(crossed.facet)) met = crossed.side;
                       return met == Meets::nothing;
                   });
    return met;
}

/// Whether some view of a point's track sees it from the side the unit normal points to, at under
/// about 87 degrees.
bool is_seen_from_front(const Scene& scene, std::uint32_t point, const Eigen::Vector3d& normal);

/// Whether a face over points of the scene has been seen: each corner by some view of its point's
/// track that the face turns its front to.
bool is_seen(const Scene& scene, const Face& points, const Eigen::Vector3d& normal);

/// Which faces have been seen at all corners, by is_seen(). Needs TriMesh::points. Cost: O(sights),
/// in parallel.
FaceFlags faces_seen_at_corners(const TriMesh& mesh, const Scene& scene);

/// Per face, how many views of its track saw the least seen corner from the front of the face: what
/// faces_seen_at_corners wants to be 1 or more. 0 where a corner is no point. Needs
/// TriMesh::points. Cost: O(faces x views of their points), in parallel.
std::vector<std::int32_t> face_supports(const TriMesh& mesh, const Scene& scene);

} // namespace vcarve

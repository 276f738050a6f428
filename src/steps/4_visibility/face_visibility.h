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

/// A view is grazing and does not see a face if the cosine of its angle to the normal is at most
/// this (about 87 degrees).
inline constexpr double kGrazing = 0.05;

/// Whether a view at `center` is in front of a position with this unit normal: the cosine of the
/// angle to the normal exceeds 0 and `cosine`. False if the normal is zero.
bool is_in_front_of(const Eigen::Vector3d& center, const Eigen::Vector3d& place,
                    const Eigen::Vector3d& normal, double cosine = kGrazing);

/// Samples of a triangle: its centroid, and positions near its corners and edge midpoints. A long
/// thin triangle has one more near each corner, about as near as its shortest edge is long. At most
/// 10.
std::vector<Eigen::Vector3d> places_on(const std::array<Eigen::Vector3d, 3>& corners);

/// Samples spread evenly over a triangle, `to_a_side` of them along each side.
std::vector<Eigen::Vector3d> grid_on(const std::array<Eigen::Vector3d, 3>& corners, int to_a_side);

/// The visibility of the boundary between inside and outside cells. A view sees a position on a
/// boundary facet if its image shows the position, the front of the facet (the outside) faces the
/// view at more than a grazing angle, and the ray between them crosses outside cells only. Facets
/// are given from their inside cells. Thread-safe. Keeps references.
class FaceVisibility {
  public:
    /// The side of the boundary that a line meets.
    enum class Meets { nothing, front, back };

    /// A boundary facet, given from its inside cell, and the side from which a line meets it.
    struct Crossed {
        CellFacet facet;
        Meets side = Meets::nothing;
    };

    FaceVisibility(const TetMesh& cells, const Labels& labels, const Scene& scene);

    const Scene& scene() const { return scene_; }

    std::array<Eigen::Vector3d, 3> corners_of(const CellFacet& facet) const;

    /// Samples of a facet, see the function for triangles.
    std::vector<Eigen::Vector3d> places_on(const CellFacet& facet) const;

    /// Whether a view sees a position on a facet, at more than a grazing angle. Cost: a walk to the
    /// view if the view is in front of the facet and its image shows the position.
    bool sees(std::uint32_t view, const CellFacet& facet, const Eigen::Vector3d& place) const;

    /// Whether any view sees a sample of a facet; any_view() describes which views are tried. Cost
    /// per sample: up to 32 walks, and one per view that saw a corner.
    bool is_seen(const CellFacet& facet) const;

    /// Whether a view sees a position on a facet if only facets with is_kept(facet) can occlude it.
    template <typename IsKept>
    bool sees_among(std::uint32_t view, const CellFacet& facet, const Eigen::Vector3d& place,
                    const IsKept& is_kept, double cosine = kGrazing) const;

    /// Whether ask(view) is true for a view that may see a position on a facet. Tries the views
    /// that saw a corner first, because they are the likeliest to see it. Then tries the nearest 32
    /// views in front of it whose images show it.
    template <typename Ask>
    bool any_view(const CellFacet& facet, const Eigen::Vector3d& place, const Ask& ask) const;

    /// Whether images and tracks agree at a facet: at each corner, one of the views in front that
    /// saw it must show it in its image, if there are any. Wrong lenses or poses violate this.
    bool has_reliable_visibility(const CellFacet& facet) const;

    /// Whether the cell behind a facet is infinite.
    bool is_before_infinity(const CellFacet& facet) const
    {
        return cells_.cells[facet.cell].is_infinite();
    }

    /// Whether the cell in front of a facet is infinite.
    bool is_on_hull(const CellFacet& facet) const
    {
        return cells_.cells[cells_.other_side(facet).cell].is_infinite();
    }

    /// The side that a view of a position on a facet would meet if the facet were removed: the
    /// front or back of the first facet behind the position with is_kept(facet).
    template <typename IsKept>
    Meets met_behind(std::uint32_t view, const CellFacet& facet, const Eigen::Vector3d& place,
                     const IsKept& is_kept) const;

  private:
    /// The normal towards the outside, not of unit length.
    Eigen::Vector3d outward(const CellFacet& facet) const;

    bool faces(std::uint32_t view, const CellFacet& facet, const Eigen::Vector3d& place,
               double cosine = kGrazing) const;

    Crossed crossed_at(const CellFacet& ahead) const;

    bool is_free(const CellFacet& ahead, const CellFacet& facet) const;

    template <typename Ask>
    bool any_view_of_corners(const CellFacet& facet, const Ask& ask) const;
    template <typename Ask>
    bool any_near_view(const CellFacet& facet, const Eigen::Vector3d& place, const Ask& ask) const;

    /// Walks from a position on a facet out of the facet's cell to a target. Calls
    /// continues(crossed) for each boundary facet after the facet itself, until it returns false.
    /// Returns false if the line does not clearly pass through the facet.
    bool along_boundary(const CellFacet& facet, const Eigen::Vector3d& place,
                        const Eigen::Vector3d& target,
                        const std::function<bool(const Crossed&)>& continues) const;

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
    const auto continues = [&](const Crossed& crossed) {
        is_free = !is_kept(crossed.facet);
        return is_free;
    };
    return along_boundary(facet, place, scene_.views[view].center, continues) && is_free;
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

/// Whether a view of a point's track sees it from the side of the unit normal, less than about 87
/// degrees from it.
bool is_seen_from_front(const Scene& scene, std::uint32_t point, const Eigen::Vector3d& normal);

/// Whether a face over points of the scene was seen: each corner has a view in its point's track
/// that is in front of the face.
bool is_seen(const Scene& scene, const Face& points, const Eigen::Vector3d& normal);

/// Flags the faces that were seen at all corners, by is_seen(). Needs TriMesh::points. Cost:
/// O(rays), in parallel.
FaceFlags faces_seen_at_corners(const TriMesh& mesh, const Scene& scene);

/// Per face, the number of views of a corner's track in front of the face, minimum over the
/// corners. faces_seen_at_corners() requires at least 1. 0 if a corner is not a point. Needs
/// TriMesh::points. Cost: O(faces x views of their points), in parallel.
std::vector<std::int32_t> face_supports(const TriMesh& mesh, const Scene& scene);

} // namespace vcarve

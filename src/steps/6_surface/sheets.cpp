#include "steps/6_surface/sheets.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/local_edges.h"
#include "mesh/surface_normals.h"
#include "model/region_of_interest.h"
#include "steps/6_surface/onlookers.h"

#include <algorithm>
#include <iterator>
#include <optional>

namespace vcarve {

namespace {

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
    return std::ranges::any_of(kCorners, [&](int corner) {
        bool is_gone = false;
        visit_beside(faces, face, corner, faces_at,
                     [&](std::uint32_t other) { is_gone = is_gone || keep[other] == 0; });
        return is_gone;
    });
}

/// Whether a face has an edge so long.
bool has_edge_of(double length, std::uint32_t face, const TriMesh& boundary)
{
    return longest_edge(boundary.positions, boundary.faces[face]) >= length;
}

/// The kept faces with an edge so long, ascending.
std::vector<std::uint32_t> faces_with_edges_of(double length, const TriMesh& boundary,
                                               const FaceFlags& keep)
{
    return parallel_collect<std::uint32_t>(keep.size(), [&](std::size_t i, auto& large) {
        const auto face = static_cast<std::uint32_t>(i);
        if (keep[i] != 0 && has_edge_of(length, face, boundary)) large.push_back(face);
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

/// Takes sheets off a boundary.
class Peeling {
  public:
    Peeling(const TriMesh& boundary, const std::vector<CellFacet>& facets,
            const FaceVisibility& visibility, FaceFlags& keep)
        : boundary_(boundary),
          facets_(facets),
          visibility_(visibility),
          keep_(keep),
          faces_at_(boundary.faces, boundary.positions.size()),
          onlookers_(visibility, facets, keep)
    {
    }

    /// Of the faces with an edge so long those that are mostly unseen, wherever they are, and from
    /// the rim inwards those several times as long that turn off the surface.
    void take_off_long(const std::vector<std::uint32_t>& long_faces, double long_edge);
    /// From the rim inwards, faces of any size of which views see nothing.
    void take_off_unseen();

    std::int64_t peeled() const { return peeled_; }

  private:
    static constexpr int kRounds = 20;
    static constexpr double kMostly = 0.5;
    static constexpr double kNothing = 0.12; // no place of seven, one of ten

    bool is_open_at(std::uint32_t face) const
    {
        return keep_[face] != 0 && (visibility_.is_on_hull(facets_[face]) ||
                                    is_at_rim(face, boundary_.faces, faces_at_, keep_));
    }
    bool is_seen_less_than(double share, std::uint32_t face) const
    {
        return visibility_.is_told_by_images(facets_[face]) &&
               onlookers_.see_less_than(share, facets_[face]);
    }
    bool is_seen_whole(std::uint32_t face) const
    {
        return visibility_.is_told_by_images(facets_[face]) &&
               !onlookers_.see_less_than(1.0, facets_[face]);
    }
    /// Whether a face that views see is so long that it may go nevertheless.
    bool is_vast(std::uint32_t face, double long_edge) const
    {
        constexpr double kSeenInPart = 2.0; // times as long; shorter ones may be plain walls
        constexpr double kSeenWhole = 3.5;  // even if views see every place on it, and something
        return has_edge_of(kSeenInPart * long_edge, face, boundary_) &&
               (has_edge_of(kSeenWhole * long_edge, face, boundary_) || !is_seen_whole(face) ||
                stands_before_nothing(face));
    }
    /// Whether images show next to no keypoints on a face, as where it hangs before the sky.
    bool stands_before_nothing(std::uint32_t face) const
    {
        constexpr double kFew = 1.0 / 3.0;
        const std::optional<double> density = onlookers_.keypoints_on(facets_[face]);
        return density && *density < kFew;
    }
    bool may_go(std::uint32_t face) const
    {
        return !onlookers_.would_see_a_back_behind(facets_[face]);
    }
    void take_off(const std::vector<std::uint32_t>& sheets)
    {
        for (const std::uint32_t face : sheets) {
            keep_[face] = 0;
        }
        peeled_ += static_cast<std::int64_t>(sheets.size());
    }
    std::vector<std::uint32_t> faces_around(const std::vector<std::uint32_t>& gone) const;

    const TriMesh& boundary_;
    const std::vector<CellFacet>& facets_;
    const FaceVisibility& visibility_;
    FaceFlags& keep_;
    VertexFaces faces_at_;
    Onlookers onlookers_;
    std::int64_t peeled_ = 0;
};

void Peeling::take_off_long(const std::vector<std::uint32_t>& long_faces, double long_edge)
{
    for (int round = 0; round < kRounds && !long_faces.empty(); ++round) {
        const LocalEdges edges(boundary_.positions, boundary_.faces, keep_);
        const SurfaceNormals normals(boundary_.positions, boundary_.faces, edges);
        const auto is_sheet = [&](std::uint32_t face) {
            if (goes_on(face, normals)) return is_seen_less_than(kNothing, face);
            return (is_open_at(face) && is_vast(face, long_edge)) ||
                   is_seen_less_than(kMostly, face);
        };
        const std::vector<std::uint32_t> sheets = those_that(long_faces, [&](std::uint32_t face) {
            return keep_[face] != 0 && is_sheet(face) && may_go(face);
        });
        take_off(sheets);
        if (sheets.empty()) break;
    }
}

/// The kept faces at the corners of faces that are gone, ascending.
std::vector<std::uint32_t> Peeling::faces_around(const std::vector<std::uint32_t>& gone) const
{
    std::vector<std::uint32_t> around;
    for (const std::uint32_t face : gone) {
        for (const std::uint32_t corner : boundary_.faces[face]) {
            std::ranges::copy_if(faces_at_[corner], std::back_inserter(around),
                                 [&](std::uint32_t other) { return keep_[other] != 0; });
        }
    }
    std::ranges::sort(around);
    around.erase(std::unique(around.begin(), around.end()), around.end());
    return around;
}

void Peeling::take_off_unseen()
{
    auto gone = parallel_collect<std::uint32_t>(keep_.size(), [&](std::size_t face, auto& found) {
        if (keep_[face] == 0) found.push_back(static_cast<std::uint32_t>(face));
    });
    for (int round = 0; round < kRounds && !gone.empty(); ++round) {
        gone = those_that(faces_around(gone), [&](std::uint32_t face) {
            return is_open_at(face) && is_seen_less_than(kNothing, face) && may_go(face);
        });
        take_off(gone);
    }
}

} // namespace

double sheet_edge(const Scene& scene, const SheetOptions& options)
{
    return options.max_sheet * 2.0 * region_of_interest(scene).radius;
}

std::int64_t peel_sheets(const TriMesh& boundary, const std::vector<CellFacet>& facets,
                         const FaceVisibility& visibility, const SheetOptions& options,
                         FaceFlags& keep)
{
    if (options.max_sheet == 0.0) return 0;
    const double long_edge = sheet_edge(visibility.scene(), options);
    const auto long_faces = faces_with_edges_of(long_edge, boundary, keep);
    if (long_faces.empty() && std::ranges::count(keep, 0) == 0) return 0; // there is no rim
    Peeling peeling(boundary, facets, visibility, keep);
    peeling.take_off_long(long_faces, long_edge);
    peeling.take_off_unseen();
    return peeling.peeled();
}

} // namespace vcarve

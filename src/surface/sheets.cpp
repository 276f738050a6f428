#include "surface/sheets.h"

#include "base/parallel.h"
#include "points/middle_box.h"
#include "surface/local_edges.h"
#include "surface/surface_normals.h"

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

    bool operator()(const CellFacet& facet) const
    {
        const auto key = [](const CellFacet& f) { return std::pair(f.cell, f.slot); };
        const auto found = std::ranges::lower_bound(facets_, key(facet), {}, key);
        return keep_[static_cast<std::size_t>(found - facets_.begin())] != 0;
    }

  private:
    const std::vector<CellFacet>& facets_;
    const FaceFlags& keep_;
};

/// Whether some view would look onto the back of a kept face, were this one away.
bool hides_a_back(const CellFacet& facet, const FaceVisibility& visibility, std::size_t num_views,
                  const KeptFacets& is_kept)
{
    const FaceVisibility::Places places = visibility.places_on(facet);
    for (std::uint32_t view = 0; view < num_views; ++view) {
        for (const Eigen::Vector3d& place : places) {
            if (visibility.sees(view, facet, place) &&
                visibility.met_behind(view, facet, place, is_kept) == FaceVisibility::Meets::back) {
                return true;
            }
        }
    }
    return false;
}

/// Whether a face goes on with the surface at one of its corners.
bool goes_on(std::size_t face, const SurfaceNormals& normals)
{
    constexpr double kGoesOn = 0.9; // cosine, about 26 degrees
    constexpr double kNotKnown = -1.0;
    return normals.cosines(face, kNotKnown)[2] >= kGoesOn;
}

} // namespace

std::int64_t peel_sheets(const TriMesh& boundary, const std::vector<CellFacet>& facets,
                         const FaceVisibility& visibility, const Scene& scene,
                         const SheetOptions& options, FaceFlags& keep)
{
    constexpr int kRounds = 4;
    if (options.max_sheet == 0.0) return 0;
    const double longest = options.max_sheet * looked_at_box(scene).diagonal().norm();
    std::int64_t peeled = 0;
    for (int round = 0; round < kRounds; ++round) {
        const LocalEdges edges(boundary.positions, boundary.faces, keep);
        const SurfaceNormals normals(boundary.positions, boundary.faces, edges);
        const KeptFacets is_kept(facets, keep);
        const auto sheets = parallel_collect<std::uint32_t>(
            keep.size(),
            [&](std::size_t face, auto& found) {
                if (keep[face] == 0 || edges.longest_edge(face) < longest) return;
                if (goes_on(face, normals)) return;
                if (hides_a_back(facets[face], visibility, scene.views.size(), is_kept)) return;
                found.push_back(static_cast<std::uint32_t>(face));
            },
            256);
        for (const std::uint32_t face : sheets) {
            keep[face] = 0;
        }
        peeled += static_cast<std::int64_t>(sheets.size());
        if (sheets.empty()) break;
    }
    return peeled;
}

} // namespace vcarve

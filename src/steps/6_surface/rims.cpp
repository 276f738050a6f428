#include "steps/6_surface/rims.h"

#include "base/median.h"
#include "base/parallel.h"
#include "mesh/local_edges.h"
#include "steps/6_surface/onlookers.h"

#include <algorithm>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// The longest edge of the median kept face.
double usual_edge(const LocalEdges& edges, const FaceFlags& keep)
{
    auto lengths = parallel_collect<double>(keep.size(), [&](std::size_t face, auto& found) {
        if (keep[face] != 0) found.push_back(edges.longest_edge(face));
    });
    return lengths.empty() ? 0.0 : median_in_place(lengths);
}

/// The faces of a boundary across the rim of those that are kept.
class Rim {
  public:
    Rim(const TriMesh& boundary, const FaceFlags& may_return, const FaceFlags& keep)
        : boundary_(boundary),
          may_return_(may_return),
          keep_(keep),
          faces_at_(boundary.faces, boundary.positions.size())
    {
    }

    /// Of a face that may return, the kept face across one of its edges and a place on that near
    /// the edge's middle; nothing where a face there is kept that lies between them, too.
    template <typename Visit>
    void visit_kept_neighbors(std::uint32_t face, const Visit& visit) const
    {
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t from = boundary_.faces[face][corner];
            const std::uint32_t to = boundary_.faces[face][(corner + 1) % 3];
            std::uint32_t kept = 0;
            int num_kept = 0;
            visit_beside(boundary_.faces, face, corner, faces_at_, [&](std::uint32_t other) {
                if (keep_[other] == 0) return;
                kept = other;
                ++num_kept;
            });
            if (num_kept == 1) visit(kept, place_at_edge(kept, from, to));
        }
    }

    /// The faces that may return, at corners of kept ones.
    std::vector<std::uint32_t> candidates() const
    {
        const auto look = [&](std::size_t face, std::vector<std::uint32_t>& found) {
            if (may_return_[face] == 0 || keep_[face] != 0) return;
            const auto is_kept = [&](std::uint32_t other) { return keep_[other] != 0; };
            if (std::ranges::any_of(boundary_.faces[face], [&](std::uint32_t corner) {
                    return std::ranges::any_of(faces_at_[corner], is_kept);
                }))
                found.push_back(static_cast<std::uint32_t>(face));
        };
        return parallel_collect<std::uint32_t>(keep_.size(), look);
    }

  private:
    Vector3d place_at_edge(std::uint32_t face, std::uint32_t from, std::uint32_t to) const
    {
        constexpr double kInwards = 0.05;
        Vector3d place = Vector3d::Zero();
        for (const std::uint32_t corner : boundary_.faces[face]) {
            const bool is_end = corner == from || corner == to;
            place += (is_end ? 0.5 * (1.0 - kInwards) : kInwards) * boundary_.positions[corner];
        }
        return place;
    }

    const TriMesh& boundary_;
    const FaceFlags& may_return_;
    const FaceFlags& keep_;
    VertexFaces faces_at_;
};

} // namespace

void round_off_rims(const TriMesh& boundary, const std::vector<CellFacet>& facets,
                    const FaceVisibility& visibility, const FaceFlags& may_return, FaceFlags& keep)
{
    constexpr double kMostLocal = 6.0;
    constexpr double kMostUsual = 4.0;
    if (std::ranges::count(may_return, 1) == 0) return;
    const Rim rim(boundary, may_return, keep);
    const std::vector<std::uint32_t> candidates = rim.candidates();
    if (candidates.empty()) return;
    const LocalEdges edges(boundary.positions, boundary.faces, keep);
    const Onlookers onlookers(visibility, facets, keep);
    const double most = kMostUsual * usual_edge(edges, keep);
    const auto look = [&](std::size_t i, std::vector<std::uint32_t>& found) {
        const std::uint32_t face = candidates[i];
        if (edges.longest_edge(face) > most || !(edges.relative_size(face) <= kMostLocal)) return;
        bool is_seen = false;
        rim.visit_kept_neighbors(face, [&](std::uint32_t kept, const Vector3d& place) {
            is_seen = is_seen || onlookers.see(facets[kept], place);
        });
        if (is_seen) found.push_back(face);
    };
    for (const std::uint32_t face : parallel_collect<std::uint32_t>(candidates.size(), look, 16)) {
        keep[face] = 1;
    }
}

} // namespace vcarve

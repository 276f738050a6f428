#include "steps/5_labels/plain_walls.h"

#include "base/arrays.h"
#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/vertices.h"
#include "model/views.h"
#include "steps/4_visibility/face_visibility.h"
#include "steps/5_labels/boundary.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <unordered_map>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr double kFlat = 0.02;        // distance to the plane, over the extent of the wall
constexpr double kTurned = 0.9;       // minimum cosine between normals
constexpr std::size_t kMinPoints = 6; // in the plane; 3 always are
constexpr double kUpright = 0.5;      // maximum cosine between up and the normal
constexpr double kHeld = 0.6;         // share of the outline; more than two sides of a triangle
constexpr std::ptrdiff_t kMinViews = 3;

/// Hull facets in one plane.
struct Wall {
    std::vector<Index> cells; ///< infinite
    Vector3d normal;          ///< of unit length
};

class Walls {
  public:
    Walls(const TetMesh& cells, const std::vector<Index>& open) : cells_(cells)
    {
        for (const Index cell : open) {
            wall_of_.emplace(cell, kNone);
        }
    }

    /// Grows a wall from a facet to adjacent facets in its plane. Skips facets of other walls.
    Wall grow(Index seed)
    {
        Wall wall{{}, face_normal(cells_.positions, face(seed))};
        if (wall_of_.at(seed) != kNone) return wall;
        const std::size_t number = num_walls_++;
        const Vector3d origin = cells_.positions[face(seed)[0]];
        double reach = longest_edge(cells_.positions, face(seed));
        const auto take = [&](Index cell) {
            wall_of_.at(cell) = number;
            wall.cells.push_back(cell);
            for (const std::uint32_t corner : face(cell)) {
                reach = std::max(reach, (cells_.positions[corner] - origin).norm());
            }
        };
        const auto is_flat = [&](Index cell) {
            return face_normal(cells_.positions, face(cell)).dot(wall.normal) >= kTurned &&
                   std::ranges::all_of(face(cell), [&](std::uint32_t corner) {
                       const Vector3d off = cells_.positions[corner] - origin;
                       return std::abs(wall.normal.dot(off)) <= kFlat * reach;
                   });
        };
        take(seed);
        // The tolerance grows with the wall, so rejected facets are tested again.
        for (std::size_t before = 0; before < wall.cells.size();) {
            before = wall.cells.size();
            std::size_t i = 0;
            while (i < wall.cells.size()) { // take() adds cells
                const Index at = wall.cells[i++];
                for (int slot = 0; slot < kHullSlot; ++slot) {
                    const Index beside = cells_.cells[at].neighbors[slot];
                    const auto found = wall_of_.find(beside);
                    if (found != wall_of_.end() && found->second == kNone && is_flat(beside))
                        take(beside);
                }
            }
        }
        return wall;
    }

    std::size_t num_points(const Wall& wall) const
    {
        std::vector<std::uint32_t> points;
        for (const Index cell : wall.cells) {
            std::ranges::copy(face(cell), std::back_inserter(points));
        }
        sort_unique(points);
        return points.size();
    }

    /// The share of the outline along which there are faces.
    double held_share(const Wall& wall, const std::vector<Face>& faces,
                      const VertexFaces& faces_at) const
    {
        const std::size_t number = wall_of_.at(wall.cells.front());
        double outline = 0.0;
        double held = 0.0;
        for (const Index cell : wall.cells) {
            for (int slot = 0; slot < kHullSlot; ++slot) {
                const auto found = wall_of_.find(cells_.cells[cell].neighbors[slot]);
                if (found != wall_of_.end() && found->second == number) continue;
                const Index a = cells_.cells[cell].vertices[(slot + 1) % 3];
                const Index b = cells_.cells[cell].vertices[(slot + 2) % 3];
                const double length = (cells_.positions[b] - cells_.positions[a]).norm();
                outline += length;
                if (std::ranges::any_of(faces_at[a], [&](std::uint32_t at) {
                        return std::ranges::count(faces[at], b) > 0;
                    }))
                    held += length;
            }
        }
        return held / outline;
    }

  private:
    static constexpr std::size_t kNone = SIZE_MAX;

    Face face(Index cell) const { return face_of(cells_, {cell, kHullSlot}); }

    const TetMesh& cells_;
    std::unordered_map<Index, std::size_t> wall_of_; ///< per open cell
    std::size_t num_walls_ = 0;
};

/// The number of views that see a sample of a wall.
std::ptrdiff_t num_views(const Wall& wall, const FaceVisibility& visibility)
{
    const std::size_t views = visibility.scene().views.size();
    const auto look = [&](std::size_t view, std::vector<std::size_t>& found) {
        if (std::ranges::any_of(wall.cells, [&](Index cell) {
                const CellFacet facet{cell, kHullSlot};
                return std::ranges::any_of(visibility.places_on(facet), [&](const Vector3d& place) {
                    return visibility.sees(static_cast<std::uint32_t>(view), facet, place);
                });
            }))
            found.push_back(view);
    };
    return std::ssize(parallel_collect<std::size_t>(views, look, 1));
}

} // namespace

std::vector<Index> plain_walls(const TetMesh& cells, const Scene& scene,
                               const std::vector<Index>& open, const Labels& labels)
{
    std::vector<std::pair<double, Index>> seeds; // large facets first
    seeds.reserve(open.size());
    for (const Index cell : open) {
        seeds.emplace_back(-face_area(cells.positions, face_of(cells, {cell, kHullSlot})), cell);
    }
    std::ranges::sort(seeds);
    const Vector3d up = up_of(scene);
    Walls walls(cells, open);
    std::vector<Wall> upright;
    for (const auto& seed : seeds) {
        Wall wall = walls.grow(seed.second);
        if (!wall.cells.empty() && std::abs(wall.normal.dot(up)) <= kUpright &&
            walls.num_points(wall) >= kMinPoints)
            upright.push_back(std::move(wall));
    }
    if (upright.empty()) return {};
    const std::vector<Face> faces = boundary_faces(cells, boundary_facets(cells, labels));
    const VertexFaces faces_at(faces, cells.positions.size());
    const FaceVisibility visibility(cells, labels, scene);
    std::vector<Index> found;
    for (const Wall& wall : upright) {
        if (walls.held_share(wall, faces, faces_at) >= kHeld &&
            num_views(wall, visibility) >= kMinViews)
            std::ranges::copy(wall.cells, std::back_inserter(found));
    }
    return found;
}

} // namespace vcarve

#include "tiles/tile_surface.h"

#include "geometry/triangle.h"
#include "mesh/collapse_edges.h"
#include "mesh/edge_table.h"
#include "mesh/half_edge_mesh.h"
#include "mesh/vertices.h"
#include "model/scene_points.h"
#include "steps/6_surface/cleanup.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Edge = std::array<std::uint32_t, 2>;

/// The vertices of a mesh, named by points and copies.
class Names {
  public:
    Names(const TriMesh& mesh, const std::vector<std::uint64_t>& point_ids)
        : names_(mesh.positions.size())
    {
        std::vector<std::uint32_t> order(names_.size());
        std::iota(order.begin(), order.end(), 0U);
        for (std::uint32_t vertex = 0; vertex < names_.size(); ++vertex) {
            names_[vertex].point = point_of(mesh, vertex, point_ids);
        }
        std::ranges::sort(order, {},
                          [&](std::uint32_t v) { return std::pair(names_[v].point, v); });
        std::vector<std::uint8_t> is_copied(names_.size());
        for (std::size_t i = 1; i < order.size(); ++i) {
            if (names_[order[i]].point != names_[order[i - 1]].point) continue;
            is_copied[order[i]] = is_copied[order[i - 1]] = 1;
        }
        number_copies(mesh, order, is_copied);
    }

    const VertexName& operator[](std::uint32_t vertex) const { return names_[vertex]; }

  private:
    using Key = std::array<std::array<std::uint64_t, 3>, 3>; ///< of a face, without copies

    static std::array<std::uint64_t, 3> point_of(const TriMesh& mesh, std::uint32_t vertex,
                                                 const std::vector<std::uint64_t>& point_ids)
    {
        const std::uint32_t point = mesh.points[vertex];
        if (point != kNoPoint) return {0, 0, point_ids[point]};
        const Vector3d& at = mesh.positions[vertex];
        return {std::bit_cast<std::uint64_t>(at.x()), std::bit_cast<std::uint64_t>(at.y()),
                std::bit_cast<std::uint64_t>(at.z())};
    }

    /// Numbers the copies of a point by their least face, which all tiles around it have.
    void number_copies(const TriMesh& mesh, const std::vector<std::uint32_t>& order,
                       const std::vector<std::uint8_t>& is_copied)
    {
        std::unordered_map<std::uint32_t, Key> least;
        for (const Face& face : mesh.faces) {
            if (std::ranges::none_of(face, [&](std::uint32_t v) { return is_copied[v] != 0; }))
                continue;
            Key key = {names_[face[0]].point, names_[face[1]].point, names_[face[2]].point};
            std::ranges::sort(key);
            for (const std::uint32_t vertex : face) {
                if (is_copied[vertex] == 0) continue;
                const auto [known, is_new] = least.try_emplace(vertex, key);
                if (!is_new) known->second = std::min(known->second, key);
            }
        }
        for (std::size_t first = 0; first < order.size();) {
            std::size_t last = first + 1;
            while (last < order.size() && names_[order[last]].point == names_[order[first]].point) {
                ++last;
            }
            std::vector<std::uint32_t> copies(order.begin() + std::ptrdiff_t(first),
                                              order.begin() + std::ptrdiff_t(last));
            if (copies.size() > 1)
                std::ranges::sort(copies, {}, [&](std::uint32_t v) { return least[v]; });
            for (std::size_t i = 0; i < copies.size(); ++i) {
                names_[copies[i]].copy = i;
            }
            first = last;
        }
    }

    std::vector<VertexName> names_;
};

/// The tile that owns a face: that of its point with the least number. Faces without points, such
/// as pieces of a trimmed face, belong to the tile of their centroid.
std::size_t owner_of(const Face& face, const TriMesh& mesh,
                     const std::vector<std::uint64_t>& point_ids, const Tiling& tiling)
{
    constexpr std::uint64_t kNone = ~std::uint64_t{0};
    std::uint64_t least = kNone;
    for (const std::uint32_t vertex : face) {
        const std::uint32_t point = mesh.points[vertex];
        if (point != kNoPoint) least = std::min(least, point_ids[point]);
    }
    if (least != kNone) return least >> 32U;
    const auto [a, b, c] = corners_of(mesh.positions, face);
    return tiling.tile_of((a + b + c) / 3.0);
}

/// The own faces of a tile, before they are simplified.
class Ownership {
  public:
    Ownership(std::size_t tile, const Tiling& tiling, const TriMesh& mesh,
              const std::vector<std::uint64_t>& point_ids)
        : sides_(mesh.positions.size())
    {
        std::vector<Face> others;
        for (const Face& face : mesh.faces) {
            const bool is_own = owner_of(face, mesh, point_ids, tiling) == tile;
            (is_own ? own_ : others).push_back(face);
            for (const std::uint32_t vertex : face) {
                sides_[vertex] |= is_own ? kOwn : kOther;
            }
        }
        for_each_shared_edge(others, [&](const Edge& edge) { edges_of_others_.push_back(edge); });
        std::ranges::sort(edges_of_others_);
    }

    const std::vector<Face>& faces() const { return own_; }
    /// Whether a vertex is in own faces and in others.
    bool is_shared(std::uint32_t vertex) const { return sides_[vertex] == (kOwn | kOther); }

    /// The edges of own faces whose other face is not.
    std::vector<Edge> seam_edges() const
    {
        std::vector<Edge> seams;
        for_each_shared_edge(own_, [&](const Edge& edge) {
            if (std::ranges::binary_search(edges_of_others_, Edge{edge[1], edge[0]}))
                seams.push_back(edge);
        });
        return seams;
    }

  private:
    static constexpr std::uint8_t kOwn = 1;
    static constexpr std::uint8_t kOther = 2;

    template <typename Visit>
    void for_each_shared_edge(const std::vector<Face>& faces, const Visit& visit) const
    {
        for (const auto& [a, b, c] : faces) {
            for (const Edge& edge : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
                if (is_shared(edge[0]) && is_shared(edge[1])) visit(edge);
            }
        }
    }

    std::vector<Face> own_;
    std::vector<std::uint8_t> sides_; ///< per vertex
    std::vector<Edge> edges_of_others_;
};

/// Simplifies faces within their noise, except along their boundary.
TriMesh decimated(const TriMesh& mesh, double spacing)
{
    constexpr double kMostMoved = 0.25; // in vertex spacings
    constexpr CleanupOptions kOnlySplit = {.min_component = 0, .max_hole = 0};
    TriMesh simple =
        collapse_edges(mesh, {.max_distance = kMostMoved * spacing, .locks_boundary = true});
    return tri_mesh(*clean_surface(std::move(simple), kOnlySplit).mesh);
}

} // namespace

TileSurface owned_faces(std::size_t tile, const Tiling& tiling, TriMesh mesh,
                        const std::vector<std::uint64_t>& point_ids,
                        const TileSimplification& simplification)
{
    TileSurface made;
    const Names names(mesh, point_ids);
    const Ownership ownership(tile, tiling, mesh, point_ids);
    if (ownership.faces().empty()) return made;
    // From here on, the points of the mesh are its vertices before.
    mesh.points.resize(mesh.positions.size());
    std::iota(mesh.points.begin(), mesh.points.end(), 0U);
    made.mesh = with_used_vertices(mesh, ownership.faces());
    if (simplification.is_wanted) made.mesh = decimated(made.mesh, simplification.spacing);
    const std::vector<std::uint32_t> before = std::exchange(made.mesh.points, {});
    if (!simplification.is_wanted) made.mesh.normals = values_at(before, mesh.normals);

    std::unordered_map<std::uint32_t, std::uint32_t> now; // of shared vertices
    for (std::uint32_t vertex = 0; vertex < before.size(); ++vertex) {
        if (before[vertex] == kNoPoint || !ownership.is_shared(before[vertex])) continue;
        now.try_emplace(before[vertex], vertex);
        made.shared.push_back(vertex);
        made.names.push_back(names[before[vertex]]);
        made.mesh.normals[vertex] = mesh.normals[before[vertex]]; // of all faces around
    }
    for (const auto& [a, b] : ownership.seam_edges()) {
        made.seam_edges.push_back({now.at(a), now.at(b)});
    }
    std::vector<std::uint8_t> is_shared(before.size());
    for (const std::uint32_t vertex : made.shared) {
        is_shared[vertex] = 1;
    }
    made.boundary_edges =
        count_boundary_edges(made.mesh.faces, before.size(), [&](std::uint32_t a, std::uint32_t b) {
            return is_shared[a] == 0 || is_shared[b] == 0;
        });
    return made;
}

} // namespace vcarve

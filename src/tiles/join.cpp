#include "tiles/join.h"

#include "mesh/edge_table.h"
#include "mesh/half_edge_mesh.h"
#include "mesh/vertices.h"
#include "model/scene_points.h"
#include "steps/6_surface/fill_holes.h"
#include "steps/6_surface/split_nonmanifold.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

using Edge = std::array<std::uint32_t, 2>;

constexpr auto kEveryEdge = [](std::uint32_t /*tail*/, std::uint32_t /*head*/) { return true; };

/// Adds the surfaces of tiles, one after the other.
class Joiner {
  public:
    /// Reserves memory for a closed surface through `points` points. What is not used costs none.
    explicit Joiner(std::size_t points)
    {
        mesh_.positions.reserve(points);
        mesh_.normals.reserve(points);
        mesh_.colors.reserve(points);
        mesh_.faces.reserve(2 * points);
    }

    void add(TileSurface tile)
    {
        TriMesh& from = tile.mesh;
        boundary_edges_ += tile.boundary_edges;
        mesh_.offset = from.offset;
        std::vector<std::uint32_t> number(from.positions.size(), kNoPoint);
        std::vector<std::uint8_t> is_shared(from.positions.size());
        std::set<std::uint32_t> met;
        for (std::size_t i = 0; i < tile.shared.size(); ++i) {
            const auto [known, is_new] = by_name_.try_emplace(tile.names[i], kNoPoint);
            if (is_new) known->second = add_vertex(from, tile.shared[i]);
            number[tile.shared[i]] = known->second;
            is_shared[tile.shared[i]] = 1;
            // Copies made by one tile alone
            if (!met.insert(known->second).second) doubtful_.insert(known->second);
        }
        for (std::uint32_t vertex = 0; vertex < number.size(); ++vertex) {
            if (number[vertex] == kNoPoint) number[vertex] = add_vertex(from, vertex);
        }
        for (Face face : from.faces) {
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = face[i];
                const std::uint32_t b = face[(i + 1) % 3];
                if (is_shared[a] != 0 && is_shared[b] != 0)
                    shared_edges_.push_back({number[a], number[b]});
            }
            for (std::uint32_t& vertex : face) {
                vertex = number[vertex];
            }
            mesh_.faces.push_back(face);
        }
        for (const auto& [a, b] : tile.seam_edges) {
            seam_edges_.push_back({number[a], number[b]});
        }
    }

    JoinedSurface join(int max_hole)
    {
        SeamCounts seams;
        const auto doubt = [&](const Edge& edge) { doubtful_.insert(edge.begin(), edge.end()); };
        std::ranges::sort(seam_edges_);
        for (const Edge& edge : seam_edges_) {
            ++seams.edges;
            if (std::ranges::binary_search(seam_edges_, Edge{edge[1], edge[0]})) continue;
            ++seams.open;
            doubt(edge);
        }
        seams.edges = (seams.edges - seams.open) / 2;
        // Tiles may have faces in the same place, and edges between the same vertices.
        std::ranges::sort(shared_edges_);
        for (const Edge& edge : shared_edges_) {
            const auto has = [&](const Edge& other) {
                const auto found =
                    std::equal_range(shared_edges_.begin(), shared_edges_.end(), other);
                return found.second - found.first;
            };
            boundary_edges_ += has(edge) == 1 && has({edge[1], edge[0]}) == 0 ? 1 : 0;
        }
        for (auto same = shared_edges_.begin();;) {
            same = std::adjacent_find(same, shared_edges_.end());
            if (same == shared_edges_.end()) break;
            doubt(*same++);
        }
        if (!doubtful_.empty()) repair(max_hole, seams);
        return {std::move(mesh_), seams, boundary_edges_};
    }

  private:
    std::uint32_t add_vertex(const TriMesh& from, std::uint32_t vertex)
    {
        mesh_.positions.push_back(from.positions[vertex]);
        if (!from.colors.empty()) mesh_.colors.push_back(from.colors[vertex]);
        mesh_.normals.push_back(from.normals[vertex]);
        return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
    }

    /// Splits doubtful vertices where the faces around them are not one fan, and fills the holes
    /// whose vertices are all doubtful.
    void repair(int max_hole, SeamCounts& seams)
    {
        TriMesh patch;
        std::vector<Face> others;
        for (const Face& face : mesh_.faces) {
            const bool is_near = std::ranges::any_of(
                face, [&](std::uint32_t vertex) { return doubtful_.contains(vertex); });
            (is_near ? patch.faces : others).push_back(face);
        }
        const std::vector<std::uint32_t> whole = used_vertices(patch.faces, mesh_.positions.size());
        renumber(patch.faces, whole, mesh_.positions.size());
        boundary_edges_ -= count_boundary_edges(patch.faces, whole.size(), kEveryEdge);
        patch.positions = values_at(whole, mesh_.positions);
        patch.colors = values_at(whole, mesh_.colors);
        patch.points = whole;
        ManifoldSurface manifold = split_nonmanifold(std::move(patch));
        std::vector<std::uint32_t> origins = manifold.mesh.points;
        // Holes with a vertex that is no point are not filled.
        for (std::uint32_t& point : manifold.mesh.points) {
            if (!doubtful_.contains(point)) point = kNoPoint;
        }
        HalfEdgeMesh repaired(manifold.mesh, manifold.twins);
        seams.filled = fill_holes(repaired, max_hole);
        boundary_edges_ += num_boundary_edges(repaired);
        set_vertex_normals(repaired);
        // Faces beyond the patch keep the other vertices together.
        std::vector<std::uint32_t> number(repaired.n_vertices(), kNoPoint);
        std::set<std::uint32_t> used;
        for (std::size_t v = 0; v < number.size(); ++v) {
            const auto vertex = handle_at<OpenMesh::VertexHandle>(v);
            const std::uint32_t origin = v < origins.size() ? origins[v] : kNoPoint;
            const bool is_copy =
                origin == kNoPoint || (doubtful_.contains(origin) && !used.insert(origin).second);
            number[v] = origin;
            if (!is_copy) continue;
            ++seams.vertices;
            number[v] = static_cast<std::uint32_t>(mesh_.positions.size());
            mesh_.positions.push_back(repaired.point(vertex));
            mesh_.normals.push_back(repaired.normal(vertex).cast<float>());
            if (!mesh_.colors.empty()) mesh_.colors.push_back(repaired.data(vertex).color);
        }
        mesh_.faces = std::move(others);
        for (std::size_t f = 0; f < repaired.n_faces(); ++f) {
            Face face{};
            std::ranges::transform(repaired.corners(handle_at<OpenMesh::FaceHandle>(f)),
                                   face.begin(),
                                   [&](auto corner) { return number[index(corner)]; });
            mesh_.faces.push_back(face);
        }
    }

    TriMesh mesh_;
    std::map<VertexName, std::uint32_t> by_name_;
    std::vector<Edge> seam_edges_;
    std::vector<Edge> shared_edges_; ///< between vertices that several tiles share
    std::int64_t boundary_edges_ = 0;
    std::set<std::uint32_t> doubtful_; ///< vertices at which tiles disagree
};

} // namespace

JoinedSurface join_tiles(std::size_t tiles, std::size_t points,
                         const std::function<TileSurface(std::size_t tile)>& surface_of,
                         int max_hole)
{
    Joiner joiner(points);
    for (std::size_t tile = 0; tile < tiles; ++tile) {
        joiner.add(surface_of(tile));
    }
    return joiner.join(max_hole);
}

} // namespace vcarve

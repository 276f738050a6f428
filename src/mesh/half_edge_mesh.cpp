#include "mesh/half_edge_mesh.h"

#include "base/median.h"
#include "base/parallel.h"

namespace vcarve {
namespace {

using Eigen::Vector3d;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// Numbers the edges of a surface by their first sides, as add_face() would, and lays half-edge
/// 2 e along the first side of edge e and half-edge 2 e + 1 against it.
class EdgeNumbers {
  public:
    explicit EdgeNumbers(std::span<const Side> twins)
        : twins_(twins),
          first_sides_(parallel_collect<Side>(twins.size(),
                                              [&](std::size_t i, auto& firsts) {
                                                  const Side side = static_cast<Side>(i);
                                                  if (side < twins[side])
                                                      firsts.push_back(
                                                          side); // none is greater than all
                                              })),
          half_edges_(twins.size())
    {
        parallel_for(first_sides_.size(), [&](std::size_t edge) {
            const Side side = first_sides_[edge];
            half_edges_[side] = static_cast<std::uint32_t>(2 * edge);
            if (twins[side] != kNoSide) half_edges_[twins[side]] = half_edges_[side] + 1;
        });
    }

    const std::vector<Side>& first_sides() const { return first_sides_; }
    bool is_border(Side side) const { return twins_[side] == kNoSide; }

    HalfedgeHandle along(Side side) const { return handle_at<HalfedgeHandle>(half_edges_[side]); }
    /// Outside of a border.
    HalfedgeHandle against(Side side) const
    {
        return handle_at<HalfedgeHandle>(half_edges_[side] ^ 1U);
    }

    /// The border that begins where the half-edge against `border` ends.
    Side next_border(Side border) const
    {
        Side side = previous_side(border);
        while (!is_border(side)) {
            side = previous_side(twins_[side]);
        }
        return side;
    }

  private:
    std::span<const Side> twins_;
    std::vector<Side> first_sides_; ///< one an edge
    std::vector<std::uint32_t> half_edges_;
};

void connect_faces(const EdgeNumbers& edges, HalfEdgeMesh& mesh)
{
    parallel_for(mesh.n_faces(), [&](std::size_t f) {
        const auto face = handle_at<FaceHandle>(f);
        const Side first = static_cast<Side>(3 * f);
        for (Side side = first; side < first + 3; ++side) {
            mesh.set_face_handle(edges.along(side), face);
            mesh.set_next_halfedge_handle(edges.along(side), edges.along(next_side(side)));
        }
        mesh.set_halfedge_handle(face, edges.along(first + 2)); // which ends at the first corner
    });
}

/// Edges get their ends, and borders a way on along the border.
void connect_edges(const std::vector<Face>& faces, const EdgeNumbers& edges, HalfEdgeMesh& mesh)
{
    parallel_for(edges.first_sides().size(), [&](std::size_t edge) {
        const Side side = edges.first_sides()[edge];
        mesh.set_vertex_handle(edges.along(side), handle_at<VertexHandle>(head(faces, side)));
        mesh.set_vertex_handle(edges.against(side), handle_at<VertexHandle>(tail(faces, side)));
        if (!edges.is_border(side)) return;
        mesh.set_next_halfedge_handle(edges.against(side), edges.against(edges.next_border(side)));
    });
}

/// A vertex gets the half-edge along its last side, or the border if it is on one: OpenMesh relies
/// on that. Not in parallel, so that the last side is the last for sure.
void connect_vertices(const std::vector<Face>& faces, const EdgeNumbers& edges, HalfEdgeMesh& mesh)
{
    for (Side side = 0; side < 3 * faces.size(); ++side) {
        mesh.set_halfedge_handle(handle_at<VertexHandle>(tail(faces, side)), edges.along(side));
    }
    for (const Side side : edges.first_sides()) {
        if (!edges.is_border(side)) continue;
        mesh.set_halfedge_handle(handle_at<VertexHandle>(head(faces, side)), edges.against(side));
    }
}

} // namespace

HalfEdgeMesh::HalfEdgeMesh(const TriMesh& mesh, std::span<const Side> twins)
    : offset_(mesh.offset),
      has_colors_(!mesh.colors.empty()),
      has_scene_points_(!mesh.points.empty())
{
    const EdgeNumbers edges(twins);
    resize(mesh.positions.size(), edges.first_sides().size(), mesh.faces.size());
    parallel_for(mesh.positions.size(), [&](std::size_t v) {
        const auto vertex = handle_at<VertexHandle>(v);
        set_point(vertex, mesh.positions[v]);
        set_normal(vertex, Vector3d::Zero());
        if (has_colors_) data(vertex).color = mesh.colors[v];
        if (has_scene_points_) data(vertex).scene_point = mesh.points[v];
    });
    connect_edges(mesh.faces, edges, *this);
    connect_faces(edges, *this);
    connect_vertices(mesh.faces, edges, *this);
}

std::array<VertexHandle, 3> HalfEdgeMesh::corners(FaceHandle face) const
{
    const HalfedgeHandle last = halfedge_handle(face);
    const HalfedgeHandle first = next_halfedge_handle(last);
    return {to_vertex_handle(last), to_vertex_handle(first),
            to_vertex_handle(next_halfedge_handle(first))};
}

std::array<Vector3d, 3> HalfEdgeMesh::triangle(FaceHandle face) const
{
    const auto [a, b, c] = corners(face);
    return {point(a), point(b), point(c)};
}

std::int64_t num_vertices_left(const HalfEdgeMesh& mesh)
{
    std::int64_t count = 0;
    for (std::size_t v = 0; v < mesh.n_vertices(); ++v) {
        count += mesh.is_deleted(handle_at<VertexHandle>(v)) ? 0 : 1;
    }
    return count;
}

std::int64_t num_faces_left(const HalfEdgeMesh& mesh)
{
    std::int64_t count = 0;
    for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
        count += mesh.is_deleted(handle_at<FaceHandle>(f)) ? 0 : 1;
    }
    return count;
}

TriMesh tri_mesh(const HalfEdgeMesh& mesh)
{
    const auto vertices =
        parallel_collect<VertexHandle>(mesh.n_vertices(), [&](std::size_t v, auto& kept) {
            const auto vertex = handle_at<VertexHandle>(v);
            if (!mesh.is_deleted(vertex)) kept.push_back(vertex);
        });
    TriMesh result;
    result.offset = mesh.offset();
    result.positions.resize(vertices.size());
    result.normals.resize(vertices.size());
    if (mesh.has_colors()) result.colors.resize(vertices.size());
    if (mesh.has_scene_points()) result.points.resize(vertices.size());
    std::vector<std::uint32_t> numbers(mesh.n_vertices());
    parallel_for(vertices.size(), [&](std::size_t i) {
        numbers[index(vertices[i])] = static_cast<std::uint32_t>(i);
        result.positions[i] = mesh.point(vertices[i]);
        result.normals[i] = mesh.normal(vertices[i]).cast<float>();
        if (mesh.has_colors()) result.colors[i] = mesh.data(vertices[i]).color;
        if (mesh.has_scene_points()) result.points[i] = mesh.data(vertices[i]).scene_point;
    });
    result.faces = parallel_collect<Face>(mesh.n_faces(), [&](std::size_t f, auto& faces) {
        const auto face = handle_at<FaceHandle>(f);
        if (mesh.is_deleted(face)) return;
        const auto [a, b, c] = mesh.corners(face);
        faces.push_back({numbers[index(a)], numbers[index(b)], numbers[index(c)]});
    });
    return result;
}

Vector3d vertex_normal(const HalfEdgeMesh& mesh, VertexHandle vertex)
{
    // OpenMesh's own: calc_vertex_normal() weighs all faces the same, ..._correct() counts the gap
    // at a border as a face.
    Vector3d sum = Vector3d::Zero();
    for (const auto incoming : mesh.vih_range(vertex)) {
        if (mesh.is_boundary(incoming)) continue;
        Vector3d twice_area;
        mesh.calc_sector_normal(incoming, twice_area);
        sum += twice_area;
    }
    return sum.normalized(); // leaves zero as it is
}

void set_vertex_normals(HalfEdgeMesh& mesh)
{
    parallel_for(mesh.n_vertices(), [&](std::size_t v) {
        const auto vertex = handle_at<VertexHandle>(v);
        if (mesh.is_deleted(vertex)) return;
        mesh.set_normal(vertex, vertex_normal(mesh, vertex));
    });
}

std::vector<double> vertex_spacings(const HalfEdgeMesh& mesh)
{
    std::vector<double> spacings(mesh.n_vertices(), 0.0);
    parallel_for_with_list<double>(spacings.size(), [&](std::size_t v, auto& lengths) {
        for (const auto edge : mesh.ve_range(handle_at<VertexHandle>(v))) {
            const double length = mesh.calc_edge_length(edge);
            lengths.push_back(length);
            if (!mesh.is_boundary(edge)) lengths.push_back(length); // each face counts its own
        }
        spacings[v] = median_in_place(lengths);
    });
    return spacings;
}

} // namespace vcarve

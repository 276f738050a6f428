#include "surface/cleanup.h"

#include "base/parallel.h"
#include "surface/collar.h"
#include "surface/fans.h"
#include "surface/split_nonmanifold.h"
#include "surface/union_find.h"
#include "surface/used_vertices.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace vcarve {
namespace {

using Eigen::Vector3d;

/// The pieces of a surface: how many faces each has, counted at its first face, and 0 elsewhere.
struct Pieces {
    UnionFind of_faces;
    std::vector<std::uint32_t> sizes;
};

Pieces find_pieces(const std::vector<Side>& mates)
{
    Pieces pieces{.of_faces = UnionFind(mates.size() / 3),
                  .sizes = std::vector<std::uint32_t>(mates.size() / 3, 0)};
    for (Side side = 0; side < mates.size(); ++side) {
        if (mates[side] != kNoSide && side < mates[side]) {
            pieces.of_faces.join(side / 3, mates[side] / 3);
        }
    }
    for (std::uint32_t face = 0; face < pieces.sizes.size(); ++face) {
        ++pieces.sizes[pieces.of_faces.root(face)];
    }
    return pieces;
}

struct Selection {
    std::vector<char> faces; ///< flags
    std::int64_t num_removed_pieces = 0;
};

/// The faces in pieces of at least so many faces; of the largest ones the first is kept in any
/// case.
Selection select_pieces(const std::vector<Side>& mates, int min_faces)
{
    Pieces pieces = find_pieces(mates);
    const auto largest = std::ranges::max_element(pieces.sizes) - pieces.sizes.begin();
    Selection keep{.faces = std::vector<char>(pieces.sizes.size())};
    for (std::uint32_t face = 0; face < keep.faces.size(); ++face) {
        const std::uint32_t first = pieces.of_faces.root(face);
        const bool keeps = first == largest || std::int64_t{pieces.sizes[first]} >= min_faces;
        keep.faces[face] = keeps ? 1 : 0;
        if (first == face && !keeps) ++keep.num_removed_pieces;
    }
    return keep;
}

/// Twice the area of a corner's face as a vector along its normal.
Vector3d twice_area(const TriMesh& mesh, Side corner)
{
    const Vector3d& here = mesh.positions[tail(mesh.faces, corner)];
    const Vector3d& next = mesh.positions[head(mesh.faces, corner)];
    const Vector3d& previous = mesh.positions[tail(mesh.faces, previous_side(corner))];
    return (next - here).cross(previous - here);
}

/// The normal of a vertex whose last corner this is, as vertex_normal() of a half-edge mesh has it
/// to the last digit, so that it does not depend on what is next to a border; zero on a border.
Vector3d normal_within(const ManifoldSurface& surface, Side last)
{
    Vector3d sum = Vector3d::Zero();
    Side corner = last;
    do {
        corner = next_corner(surface.mates, corner);
        if (corner == kNoSide) return Vector3d::Zero();
        sum += twice_area(surface.mesh, corner);
    } while (corner != last);
    const double norm_sq = sum.x() * sum.x() + sum.y() * sum.y() + sum.z() * sum.z();
    return norm_sq > 0.0 ? Vector3d(sum / std::sqrt(norm_sq)) : sum;
}

/// The normals of vertices off the borders, zero for others.
std::vector<Eigen::Vector3f> normals_within(const ManifoldSurface& surface)
{
    const VertexCorners corners(surface.mesh.faces, surface.mesh.positions.size());
    std::vector<Eigen::Vector3f> normals(surface.mesh.positions.size(), Eigen::Vector3f::Zero());
    parallel_for(normals.size(), [&](std::size_t vertex) {
        if (corners.count(vertex) == 0) return;
        normals[vertex] = normal_within(surface, corners.last(vertex)).cast<float>();
    });
    return normals;
}

template <typename Value>
std::vector<Value> picked(const std::vector<Value>& values, const std::vector<std::uint32_t>& which)
{
    std::vector<Value> some(values.empty() ? 0 : which.size());
    parallel_for(some.size(), [&](std::size_t i) { some[i] = values[which[i]]; });
    return some;
}

/// The faces with a flag, and those after the last flag, with their vertices.
TriMesh kept_part(TriMesh mesh, const std::vector<char>& keep_faces)
{
    mesh.faces = parallel_collect<Face>(mesh.faces.size(), [&](std::size_t i, auto& faces) {
        if (i >= keep_faces.size() || keep_faces[i] != 0) faces.push_back(mesh.faces[i]);
    });
    const std::vector<std::uint32_t> used = used_vertices(mesh.faces, mesh.positions.size());
    renumber(mesh.faces, used, mesh.positions.size());
    mesh.positions = picked(mesh.positions, used);
    mesh.normals = picked(mesh.normals, used);
    mesh.colors = picked(mesh.colors, used);
    mesh.points = picked(mesh.points, used);
    return mesh;
}

} // namespace

CleanSurface clean_surface(TriMesh mesh, const CleanupOptions& options)
{
    // Take apart what OpenMesh cannot hold.
    ManifoldSurface manifold = split_nonmanifold(std::move(mesh));

    // Small pieces go before holes are filled: a hole in one of them is none of ours.
    const Selection keep = select_pieces(manifold.mates, options.min_component_faces);
    Collar collar(manifold.mesh, manifold.mates, keep.faces);

    CleanSurface result;
    result.counts.split_edges = manifold.split_edges;
    result.counts.split_vertices = manifold.split_vertices;
    result.counts.removed_components = keep.num_removed_pieces;
    result.counts.filled_holes = collar.fill_holes(options.max_hole_edges);

    manifold.mesh.normals = normals_within(manifold);
    collar.add_to(manifold.mesh);
    const std::size_t num_vertices = manifold.mesh.positions.size();
    result.mesh = kept_part(std::move(manifold.mesh), keep.faces);
    result.counts.removed_vertices =
        static_cast<std::int64_t>(num_vertices - result.mesh.positions.size());
    return result;
}

} // namespace vcarve

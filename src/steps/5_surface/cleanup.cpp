#include "steps/5_surface/cleanup.h"

#include "base/parallel.h"
#include "base/union_find.h"
#include "mesh/fans.h"
#include "mesh/used_vertices.h"
#include "steps/5_surface/border_strip.h"
#include "steps/5_surface/split_nonmanifold.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace vcarve {
namespace {

using Eigen::Vector3d;

/// The first face of each face's piece.
std::vector<std::uint32_t> find_pieces(const std::vector<Side>& mates)
{
    UnionFind pieces(mates.size() / 3);
    parallel_for(mates.size(), [&](std::size_t side) {
        const Side mate = mates[side];
        if (mate != kNoSide && side < mate) pieces.join(static_cast<Side>(side) / 3, mate / 3);
    });
    std::vector<std::uint32_t> firsts(mates.size() / 3);
    parallel_for(firsts.size(), [&](std::size_t face) {
        firsts[face] = pieces.root(static_cast<std::uint32_t>(face));
    });
    return firsts;
}

struct Selection {
    std::vector<char> faces; ///< flags
    std::int64_t num_removed_pieces = 0;
};

/// The faces in pieces of at least so many faces; of the largest ones the first is kept in any
/// case.
Selection select_pieces(const std::vector<Side>& mates, int min_faces)
{
    const std::vector<std::uint32_t> firsts = find_pieces(mates);
    std::vector<std::uint32_t> sizes(firsts.size(), 0); // of pieces, at their first faces
    for (const std::uint32_t first : firsts) {
        ++sizes[first];
    }
    const auto largest = std::ranges::max_element(sizes) - sizes.begin();
    const auto keeps = [&](std::uint32_t first) {
        return first == largest || std::int64_t{sizes[first]} >= min_faces;
    };
    Selection keep{.faces = std::vector<char>(firsts.size())};
    parallel_for(firsts.size(),
                 [&](std::size_t face) { keep.faces[face] = keeps(firsts[face]) ? 1 : 0; });
    for (std::uint32_t face = 0; face < sizes.size(); ++face) {
        if (sizes[face] != 0 && !keeps(face)) ++keep.num_removed_pieces;
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

/// The normal of a vertex with this corner, off the borders as vertex_normal() of a half-edge
/// mesh has it, to the last digit: what else there is in the surface does not matter.
Vector3d normal_of_fan(const ManifoldSurface& surface, Side corner)
{
    Side last = corner; // where OpenMesh begins
    for_each_corner_of_fan(surface.mates, corner,
                           [&](Side other) { last = std::max(last, other); });

    Vector3d sum = Vector3d::Zero();
    for_each_corner_of_fan(surface.mates, last,
                           [&](Side other) { sum += twice_area(surface.mesh, other); });
    const double norm_sq = sum.x() * sum.x() + sum.y() * sum.y() + sum.z() * sum.z();
    return norm_sq > 0.0 ? Vector3d(sum / std::sqrt(norm_sq)) : sum;
}

/// The normals of all vertices, on borders without what fills their holes; zero where none has an
/// area.
std::vector<Eigen::Vector3f> normals_of_fans(const ManifoldSurface& surface)
{
    const std::vector<Side> corners =
        corners_of_vertices(surface.mesh.faces, surface.mesh.positions.size());
    std::vector<Eigen::Vector3f> normals(corners.size(), Eigen::Vector3f::Zero());
    parallel_for(normals.size(), [&](std::size_t vertex) {
        if (corners[vertex] == kNoSide) return;
        normals[vertex] = normal_of_fan(surface, corners[vertex]).cast<float>();
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

    manifold.mesh.normals = normals_of_fans(manifold);
    collar.add_to(manifold.mesh);
    const std::size_t num_vertices = manifold.mesh.positions.size();
    result.mesh = kept_part(std::move(manifold.mesh), keep.faces);
    result.counts.removed_vertices =
        static_cast<std::int64_t>(num_vertices - result.mesh.positions.size());
    return result;
}

} // namespace vcarve

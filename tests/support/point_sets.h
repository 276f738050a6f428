#pragma once

#include "model/tet_mesh.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace vcarve {

using Positions = std::vector<Eigen::Vector3d>;

/// Evenly spread in [low, high), the same numbers with every standard library.
double even(std::mt19937_64& random, double low, double high);
Eigen::Vector3d even_in_cube(std::mt19937_64& random, double low, double high);
/// An index below `count`.
std::size_t pick(std::mt19937_64& random, std::size_t count);

/// Points spread evenly in the unit cube.
Positions random_points(std::size_t count, std::uint64_t seed);
/// n^3 points with whole coordinates from 0 to n - 1.
Positions lattice(int n);
/// The lattice and the centres of its cubes.
Positions body_centered_lattice(int n);
/// So many points on each of two lines that do not meet: every two neighbours on one make a cell
/// with every two on the other.
Positions two_skew_lines(int points_of_line);
/// 30 points with whole coordinates on the sphere of radius 3 around the origin.
Positions points_on_sphere();
/// Off one sphere by as much as `noise`, of its radius, so that the tetrahedra amid them are all
/// slivers.
Positions nearly_on_a_sphere(std::size_t count, double noise);
/// Every coordinate moved by up to `reach` at random.
Positions jittered(Positions points, double reach, std::uint64_t seed);
/// x -> factor * x + shift
Positions mapped(Positions points, double factor, const Eigen::Vector3d& shift);

/// A scene of points alone: no views, no sights.
Scene scene_of(const Positions& positions);
TetMesh triangulation_of(const Positions& positions);

/// The points seen from the centres, each by about `share` of the views, chosen at random.
Scene scene_seen_from(const Positions& centers, const Positions& points, double share,
                      std::uint64_t seed);

/// A triangulation with a name for messages.
struct NamedCells {
    std::string name;
    TetMesh mesh;
    double step; ///< how far apart its points are, for choosing targets
};
/// Triangulations on which walks are hard: general, regular, nearly regular, flat, far from the
/// origin, tiny, huge.
std::vector<NamedCells> meshes_to_walk();

/// A target for a sight from a vertex, of one of many sorts: anywhere in the hull or out of it, at
/// and beyond vertices, edges and facets, on half steps of a lattice, at the vertex itself.
Eigen::Vector3d any_target(const NamedCells& named, Index vertex, std::mt19937_64& random);

} // namespace vcarve

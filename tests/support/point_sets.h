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

/// Uniformly distributed in [low, high); the same numbers with every standard library.
double even(std::mt19937_64& random, double low, double high);
Eigen::Vector3d even_in_cube(std::mt19937_64& random, double low, double high);
/// An index below `count`.
std::size_t pick(std::mt19937_64& random, std::size_t count);

/// Uniformly distributed points in the unit cube.
Positions random_points(std::size_t count, std::uint64_t seed);
/// n^3 points with integer coordinates from 0 to n - 1.
Positions lattice(int n);
/// The lattice and the centers of its cubes.
Positions body_centered_lattice(int n);
/// Points on two skew lines. Any two neighbors on one line form a cell with any two neighbors on
/// the other.
Positions two_skew_lines(int points_of_line);
/// 30 points with integer coordinates on the sphere of radius 3 around the origin.
Positions points_on_sphere();
/// Points on the unit sphere, off by up to `noise`, so that all tetrahedra inside are slivers.
Positions nearly_on_a_sphere(std::size_t count, double noise);
/// Moves every coordinate randomly by up to `reach`.
Positions jittered(Positions points, double reach, std::uint64_t seed);
/// x -> factor * x + shift
Positions mapped(Positions points, double factor, const Eigen::Vector3d& shift);

/// A scene of points without views and rays.
Scene scene_of(const Positions& positions);
TetMesh triangulation_of(const Positions& positions);

/// A scene of views at `centers`. A random fraction `share` of them sees each point.
Scene scene_seen_from(const Positions& centers, const Positions& points, double share,
                      std::uint64_t seed);

/// A triangulation with a name for messages.
struct NamedCells {
    std::string name;
    TetMesh mesh;
    double step; ///< the distance between its points, for choosing targets
};
/// Triangulations that are hard to walk: random, regular, nearly regular, flat, far from the
/// origin, tiny, huge.
std::vector<NamedCells> meshes_to_walk();

/// A random target for a ray from a vertex: anywhere inside or outside the hull, at or beyond
/// vertices, edges and facets, at half steps of a lattice, or at the vertex itself.
Eigen::Vector3d any_target(const NamedCells& named, Index vertex, std::mt19937_64& random);

} // namespace vcarve

#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace vcarve::testing {

using Cell = std::array<std::uint32_t, 4>; ///< positively oriented

/// A block of n x n x n unit cubes, each cut into six tetrahedra around its diagonal.
struct TetraGrid {
    std::vector<Eigen::Vector3d> positions;
    std::vector<Cell> cells;
};

inline TetraGrid tetra_grid(std::uint32_t n)
{
    TetraGrid grid;
    const auto vertex = [n](std::array<std::uint32_t, 3> p) {
        return p[0] + (n + 1) * (p[1] + (n + 1) * p[2]);
    };
    for (std::uint32_t v = 0; v < (n + 1) * (n + 1) * (n + 1); ++v) {
        grid.positions.emplace_back(v % (n + 1), v / (n + 1) % (n + 1), v / (n + 1) / (n + 1));
    }
    for (std::uint32_t cube = 0; cube < n * n * n; ++cube) {
        std::array<int, 3> axes{0, 1, 2};
        do {
            // Each order of the axes is a path along edges from one end of the diagonal to the
            // other.
            std::array<std::uint32_t, 3> p{cube % n, cube / n % n, cube / n / n};
            Cell cell{vertex(p), 0, 0, 0};
            for (std::size_t i = 0; i < 3; ++i) {
                ++p[static_cast<std::size_t>(axes[i])];
                cell[i + 1] = vertex(p);
            }
            const auto at = [&](std::size_t i) { return grid.positions[cell[i]]; };
            if ((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) < 0) {
                std::swap(cell[2], cell[3]);
            }
            grid.cells.push_back(cell);
        } while (std::ranges::next_permutation(axes).found);
    }
    return grid;
}

/// The boundary of the inside cells, oriented outward, each facet once.
inline TriMesh boundary_of(const TetraGrid& grid, const std::vector<bool>& inside)
{
    std::map<std::set<std::uint32_t>, std::vector<Face>> facets;
    for (std::size_t c = 0; c < grid.cells.size(); ++c) {
        if (!inside[c]) continue;
        const Cell& t = grid.cells[c];
        for (const Face face : {Face{t[1], t[2], t[3]}, Face{t[0], t[3], t[2]},
                                Face{t[0], t[1], t[3]}, Face{t[0], t[2], t[1]}}) {
            facets[std::set<std::uint32_t>(face.begin(), face.end())].push_back(face);
        }
    }
    TriMesh mesh;
    mesh.positions = grid.positions;
    for (const auto& [corners, faces] : facets) {
        if (faces.size() == 1) mesh.faces.push_back(faces[0]);
    }
    return mesh;
}

inline std::vector<bool> random_labels(std::size_t count, double share, std::mt19937& random)
{
    std::vector<bool> inside(count);
    for (std::size_t i = 0; i < count; ++i) {
        inside[i] = random() < share * 4294967296.0;
    }
    return inside;
}

/// The volume of a closed surface; of an open surface, the volume of the cone to the origin.
inline double volume(const TriMesh& mesh)
{
    double sum = 0.0;
    for (const Face& face : mesh.faces) {
        sum += mesh.positions[face[0]].dot(mesh.positions[face[1]].cross(mesh.positions[face[2]])) /
               6.0;
    }
    return sum;
}

} // namespace vcarve::testing

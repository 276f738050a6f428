#pragma once

#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::paper {

/// An object of fixtures/paper, and its cells. Vertex i of the solid, of the cells and of the scene
/// is the same point.
struct PaperCase {
    std::string name;
    Scene scene;
    TriMesh solid; ///< the true solid
    TetMesh cells;
    Crossings crossings; ///< of all rays
    Labels truth;        ///< from strict carving; is_exact() verifies that they are true
};

PaperCase read_case(const std::filesystem::path& fixtures, const std::string& name);

/// The number of a scene's rays that cross each facet.
Crossings crossings_of(const TetMesh& cells, const Scene& scene);

/// The scene with the rays of some views only. It keeps all points, so its cells are the same.
Scene seen_by(const Scene& scene, const std::vector<std::uint32_t>& views);

/// The sorted positions of the faces' corners. Each face begins at its least corner.
std::vector<std::array<std::array<double, 3>, 3>> sorted_places(const TriMesh& mesh);

/// Whether a surface has exactly the faces of the true solid, with the same orientation.
bool is_exact(const TriMesh& surface, const TriMesh& solid);

/// The volume and area of a closed surface.
double volume_of(const TriMesh& surface);
double area_of(const TriMesh& surface);

/// Wrongly labeled finite cells.
struct Mistakes {
    std::size_t lost = 0; ///< cells of the solid labeled outside
    std::size_t kept = 0; ///< cells of empty space labeled inside
    double kept_volume = 0.0;
};
Mistakes mistakes_of(const PaperCase& paper_case, const Labels& labels);

/// Greedily selects views that carve the most remaining empty cells; the first of equals.
std::vector<std::uint32_t> views_that_open_most(const PaperCase& paper_case, std::size_t count);

} // namespace vcarve::paper

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

/// An object of the paper as fixtures/paper has it, and its cells. Vertex i of the solid, of the
/// cells and of the scene are the same point.
struct PaperCase {
    std::string name;
    Scene scene;
    TriMesh solid; ///< the true one
    TetMesh cells;
    Crossings crossings; ///< of all sights
    Labels truth;        ///< strictly carved; is_exact() says whether they are what they are called
};

PaperCase read_case(const std::filesystem::path& fixtures, const std::string& name);

/// How many of a scene's sights cross each facet.
Crossings crossings_of(const TetMesh& cells, const Scene& scene);

/// The scene as some of its views saw it. All points stay, so that its cells are the same.
Scene seen_by(const Scene& scene, const std::vector<std::uint32_t>& views);

/// The faces by the places of their corners, each begun at its least corner, all in order.
std::vector<std::array<std::array<double, 3>, 3>> sorted_places(const TriMesh& mesh);

/// Whether a surface has the true solid's faces, each to its side, no more and no less.
bool is_exact(const TriMesh& surface, const TriMesh& solid);

/// Of a closed surface.
double volume_of(const TriMesh& surface);
double area_of(const TriMesh& surface);

/// Finite cells that a labelling gets wrong.
struct Mistakes {
    std::size_t lost = 0; ///< cells of the solid called outside
    std::size_t kept = 0; ///< cells of empty space called inside
    double kept_volume = 0.0;
};
Mistakes mistakes_of(const PaperCase& paper_case, const Labels& labels);

/// The views that open most empty cells one after another, each the first of the best.
std::vector<std::uint32_t> views_that_open_most(const PaperCase& paper_case, std::size_t count);

} // namespace vcarve::paper

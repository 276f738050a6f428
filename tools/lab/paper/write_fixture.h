#pragma once

#include "paper/box_solid.h"
#include "paper/place_views.h"
#include "paper/sample_surface.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::paper {

/// One object, its exact model, and what strict carving must make of it.
struct Fixture {
    std::string name;
    BoxSolid solid;
    std::vector<Spot> samples;
    Cells cells;
    std::vector<ExactView> views;
};

/// Writes cameras.txt, images.txt, points3D.txt and solid.ply into a folder. Point i + 1 of the
/// model is vertex i of solid.ply.
void write_fixture(const std::filesystem::path& folder, const Fixture& fixture);

/// Whether strict carving gives the true solid: looks at every facet for every sight, with CGAL's
/// exact predicates on the doubles a reader gets (centre = -R^T t). Throws where it does not.
void check_carving(const Fixture& fixture);

} // namespace vcarve::paper

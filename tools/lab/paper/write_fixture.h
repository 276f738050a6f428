#pragma once

#include "paper/box_solid.h"
#include "paper/place_views.h"
#include "paper/sample_surface.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::paper {

/// An object, its exact model, and the expected result of strict carving.
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

/// Throws if strict carving does not give the true solid. Tests every facet with every ray, with
/// CGAL's exact predicates, on the doubles that a reader computes (center = -R^T t).
void check_carving(const Fixture& fixture);

/// An object made of boxes.
struct Object {
    std::string name;
    double max_radius;                        ///< of a circumscribed circle, in scene units
    std::vector<std::array<double, 6>> boxes; ///< x0 y0 z0 x1 y1 z1
};

/// The objects of figures 15-18 of Akgunduz, Zetu, Banerjee, "Viewpoint-centered shape recovery
/// from multiple views" (2000).
std::vector<Object> objects();

/// Samples the object, with other jitter each time, until its triangulation fits. The same object
/// always gives the same fixture. Throws if no sampling fits.
Fixture make_fixture(const Object& object);

} // namespace vcarve::paper

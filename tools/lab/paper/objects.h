#pragma once

#include "paper/write_fixture.h"

#include <array>
#include <string>
#include <vector>

namespace vcarve::paper {

/// An object that boxes make up.
struct Object {
    std::string name;
    double max_radius;                        ///< of a triangle's circle, in scene units
    std::vector<std::array<double, 6>> boxes; ///< x0 y0 z0 x1 y1 z1
};

/// The objects of figures 15-18 of Akgunduz, Zetu, Banerjee, "Viewpoint-centered shape recovery
/// from multiple views" (2000).
std::vector<Object> objects();

/// Samples the object until its triangulation fits it, each time with other jitter. The same object
/// always gives the same fixture. Throws where no sampling fits.
Fixture make_fixture(const Object& object);

} // namespace vcarve::paper

#include "paper/objects.h"

#include <random>
#include <stdexcept>

namespace vcarve::paper {

std::vector<Object> objects()
{
    return {
        {"cube_with_cavity",
         1.0,
         {{0, 0, 0, 4, 4, 1.5}, // below the cavity
          {0, 0, 1.5, 1, 4, 4}, // its four walls
          {3, 0, 1.5, 4, 4, 4},
          {1, 0, 1.5, 3, 1, 4},
          {1, 3, 1.5, 3, 4, 4}}},
        {"boissonnat",
         1.25,
         {{0, 0, 0, 4.25, 4, 1},      // base
          {0, 0, 1, 2.75, 4, 4},      // thick block
          {3.25, 0, 1, 4.25, 4, 4}}}, // thin plate across a narrow slot
        {"cubicles",
         1.0,
         {{0, 0, 0, 6, 6, 0.75},      // floor
          {0, 2.5, 0.75, 3, 3, 2.25}, // partitions along x, staggered
          {3, 3, 0.75, 6, 3.5, 2.25},
          {2.75, 0, 0.75, 3.25, 6, 2.25}, // partition along y
          {0, 0, 0.75, 0.5, 6, 2.25},     // outer walls
          {5.5, 0, 0.75, 6, 6, 2.25}}},
        {"desk",
         1.0,
         {{0, 0, 3, 6, 3, 3.5},          // top
          {0, 0, 0, 0.5, 3, 3},          // side panel
          {4.25, 0, 0, 6, 3, 3},         // block of drawers
          {0.5, 2.5, 0.5, 4.25, 3, 2}}}, // back panel, open above: a handle
    };
}

Fixture make_fixture(const Object& object)
{
    constexpr int kMostSeeds = 100;
    const BoxSolid solid(object.boxes);
    for (int seed = 1; seed <= kMostSeeds; ++seed) {
        std::mt19937_64 random(seed);
        const auto max_radius = static_cast<std::int64_t>(object.max_radius * kSpotsPerUnit);
        const std::vector<Spot> samples = sample_surface(solid, max_radius, random);
        const auto cells = triangulate(solid, samples);
        if (!cells) continue;
        const auto views = place_views(solid, samples, *cells, random);
        return {object.name, solid, samples, *cells, views};
    }
    throw std::runtime_error(object.name + ": no sampling fits the object");
}

} // namespace vcarve::paper

// Makes fixtures/paper: the objects of figures 15-18 of Akgunduz, Zetu, Banerjee,
// "Viewpoint-centered shape recovery from multiple views" (2000), as exact models. Usage:
// make_paper_fixtures FOLDER
#include "paper/box_solid.h"
#include "paper/place_views.h"
#include "paper/sample_surface.h"
#include "paper/write_fixture.h"

#include <fmt/format.h>

#include <array>
#include <exception>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace vcarve::paper;

struct Object {
    std::string name;
    double max_radius;                        ///< of a triangle's circle, in scene units
    std::vector<std::array<double, 6>> boxes; ///< x0 y0 z0 x1 y1 z1
};

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

/// Samples the object until its triangulation fits it, each time with other jitter.
Fixture make(const Object& object, const BoxSolid& solid)
{
    constexpr int kMostSeeds = 100;
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

std::size_t count_sights(const Fixture& fixture)
{
    std::size_t sum = 0;
    for (const ExactView& view : fixture.views) {
        sum += view.sees.size();
    }
    return sum;
}

/// Handles of a closed surface in one piece, from Euler's formula.
long genus(const Fixture& fixture)
{
    const long faces = static_cast<long>(fixture.cells.boundary.size());
    const long vertices = static_cast<long>(fixture.samples.size());
    return (2 - (vertices - faces * 3 / 2 + faces)) / 2;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 2) {
        fmt::print(stderr, "usage: make_paper_fixtures FOLDER\n");
        return 2;
    }
    try {
        for (const Object& object : objects()) {
            const BoxSolid solid(object.boxes);
            const Fixture fixture = make(object, solid);
            check_carving(fixture);
            write_fixture(std::filesystem::path(argv[1]) / object.name, fixture);
            fmt::print("{}: {} points, {} views, {} sights, {} solid and {} empty cells, {} faces, "
                       "genus {}\n",
                       object.name, fixture.samples.size(), fixture.views.size(),
                       count_sights(fixture), fixture.cells.solid.size(),
                       fixture.cells.empty.size(), fixture.cells.boundary.size(), genus(fixture));
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "make_paper_fixtures: {}\n", error.what());
        return 1;
    }
    return 0;
}

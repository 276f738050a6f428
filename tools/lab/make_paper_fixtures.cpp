// Makes fixtures/paper: the objects of figures 15-18 of Akgunduz, Zetu, Banerjee,
// "Viewpoint-centered shape recovery from multiple views" (2000), as exact models. Usage:
// make_paper_fixtures FOLDER
#include "paper/write_fixture.h"
#include "run_program.h"

#include <fmt/format.h>

namespace vcarve::paper {

namespace {

std::size_t count_rays(const Fixture& fixture)
{
    std::size_t sum = 0;
    for (const ExactView& view : fixture.views) {
        sum += view.sees.size();
    }
    return sum;
}

/// The genus of a closed connected surface, from Euler's formula.
long genus(const Fixture& fixture)
{
    const long faces = static_cast<long>(fixture.cells.boundary.size());
    const long vertices = static_cast<long>(fixture.samples.size());
    return (2 - (vertices - faces * 3 / 2 + faces)) / 2;
}

void make_all(const std::filesystem::path& folder)
{
    for (const Object& object : objects()) {
        const Fixture fixture = make_fixture(object);
        check_carving(fixture);
        write_fixture(folder / object.name, fixture);
        fmt::print("{}: {} points, {} views, {} rays, {} solid and {} empty cells, {} faces, "
                   "genus {}\n",
                   object.name, fixture.samples.size(), fixture.views.size(), count_rays(fixture),
                   fixture.cells.solid.size(), fixture.cells.empty.size(),
                   fixture.cells.boundary.size(), genus(fixture));
    }
}

} // namespace

} // namespace vcarve::paper

int main(int argc, char** argv)
{
    return vcarve::run_program(std::span(argv, static_cast<std::size_t>(argc)),
                               "make_paper_fixtures FOLDER", 1, 1,
                               [](std::span<char*> words) { vcarve::paper::make_all(words[0]); });
}

// Computes the figures of docs/paper.md, which are those of Akgunduz, Zetu, Banerjee,
// "Viewpoint-centered shape recovery from multiple views" (2000). Usage: make_paper_figures
// FIXTURES, the folder fixtures/paper. Writes JSON to standard output for tools/docs/paper.
#include "figures/figures.h"
#include "run_program.h"

#include <fmt/format.h>

#include <filesystem>

namespace vcarve::paper {

namespace {

Json all_figures(const std::filesystem::path& fixtures)
{
    const PaperCase cube = read_case(fixtures, "cube_with_cavity");
    const PaperCase boissonnat = read_case(fixtures, "boissonnat");
    const PaperCase cubicles = read_case(fixtures, "cubicles");
    const PaperCase desk = read_case(fixtures, "desk");
    Json sceneries = Json::object();
    for (const PaperCase* paper_case : {&cube, &boissonnat, &cubicles, &desk}) {
        sceneries[paper_case->name] = scenery(paper_case->cells);
    }
    return {{"sceneries", sceneries},
            {"figure1", sculpted(boissonnat)},
            {"figure2", alpha_shapes(desk)},
            {"figure3", alpha_shapes(cubicles)},
            {"figure13", unmet_triangles(cube)},
            {"figure15", recovered(cube)},
            {"figure16", recovered(boissonnat)},
            {"figure17", recovered_in_states(cubicles)},
            {"figure18", recovered(desk)},
            {"virtual", virtual_viewpoints(cube)},
            {"drilled", drilled(boissonnat)}};
}

} // namespace

} // namespace vcarve::paper

int main(int argc, char** argv)
{
    return vcarve::run_program(std::span(argv, static_cast<std::size_t>(argc)),
                               "make_paper_figures FIXTURES", 1, 1, [](std::span<char*> words) {
                                   fmt::print("{}\n", vcarve::paper::all_figures(words[0]).dump());
                               });
}

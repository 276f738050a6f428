// example_reconstruct MODEL OUT.ply: makes the surface of a COLMAP model, in thirty lines. ctrl-C
// cancels the run through the log.
#include <vcarve/vcarve.h>

#include <csignal>
#include <iostream>

namespace {
volatile std::sig_atomic_t interrupted = 0;

struct ShowStages : vcarve::Log {
    void stage_begins(std::string_view name) override { std::cerr << name << "...\n"; }
    bool wants_stop() const override { return interrupted != 0; }
};
} // namespace

int main(int count, char** words)
{
    if (count != 3) return 2;
    std::signal(SIGINT, [](int) { interrupted = 1; });
    try {
        ShowStages log;
        vcarve::Options options;
        options.surface.cleanup.max_hole_edges = 20;
        vcarve::Scene scene = vcarve::read_model(words[1], log);
        const auto made = vcarve::reconstruct(std::move(scene), options, log);
        vcarve::write_mesh(words[2], made.mesh, {});
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}

// colmap-vcarve-mpi: colmap-vcarve for several processes, started by mpirun, srun, a job array or
// by hand. They share the tiles of a model through the files of --work, without messages.
#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/mesh_arguments.h"

#include <algorithm>
#include <string>
#include <vector>

namespace {

namespace cli = vcarve::cli;

cli::Manual manual()
{
    cli::Manual manual = cli::mesh_manual();
    manual.command = "colmap-vcarve-mpi";
    manual.summary = "Turn a COLMAP model into a triangle mesh, with several processes.";
    manual.examples = {
        {"mpirun -n 4 colmap-vcarve-mpi sparse/0 mesh.ply --work DIR", "on one machine"},
        {"srun -n 64 colmap-vcarve-mpi sparse/0 mesh.ply --work DIR", "with Slurm"},
    };
    manual.ends.insert(manual.ends.begin(),
                       {"Start each process with the same command, and --work in a folder that all",
                        "share. --tile-points is 250000 by default. If a process dies, the others",
                        "do its work."});
    return manual;
}

void run(std::vector<std::string> arguments)
{
    const auto is_tile_option = [](const std::string& word) {
        return word.starts_with("--tile-points");
    };
    if (std::ranges::none_of(arguments, is_tile_option)) {
        // For any number of processes. Words after `--` are no options.
        arguments.emplace(std::ranges::find(arguments, "--"), "--tile-points=250000");
    }
    const cli::Command command = {"", manual, cli::run_mesh};
    cli::run_command_line(arguments, {&command, 1});
}

} // namespace

int main(int count, char** words)
{
    cli::open_standard_streams();
    return cli::report(cli::ending_of([&] { run({words + (count > 0 ? 1 : 0), words + count}); }));
}

// colmap-vcarve-mpi: the same command for several processes on one or more machines, started by
// mpirun or srun. Rank 0 runs the command; the other ranks do shares of it.
#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/mesh_arguments.h"
#include "mpi/follower.h"
#include "mpi/leader.h"
#include "mpi/session.h"

#include <string>
#include <vector>

namespace {

namespace cli = vcarve::cli;
namespace mpi = vcarve::mpi;

cli::Manual manual()
{
    cli::Manual manual = cli::mesh_manual();
    manual.command = "colmap-vcarve-mpi";
    manual.summary = "Turn a COLMAP model into a triangle mesh, on many machines.";
    manual.examples = {
        {"mpirun -n 4 colmap-vcarve-mpi sparse/0 mesh.ply --work DIR", "on four processes"},
        {"srun --mpi=pmix colmap-vcarve-mpi sparse/0 mesh.ply --work DIR", "with Slurm"},
    };
    manual.ends.insert(manual.ends.begin(),
                       {"Start every rank with the same command, and --work in a folder that all",
                        "ranks share. If a rank dies, the same command resumes the run."});
    return manual;
}

void lead(const std::vector<std::string>& arguments, const mpi::Session& session)
{
    mpi::Leader others(session);
    const cli::Command command = {
        "", manual, [&](const cli::ParsedArguments& given) { cli::run_mesh(given, &others); }};
    cli::run_command_line(arguments, {&command, 1});
}

} // namespace

int main(int count, char** words)
{
    const mpi::Session session(&count, &words);
    const std::vector<std::string> arguments(words + (count > 0 ? 1 : 0), words + count);
    if (session.rank().number == 0) {
        return cli::report(cli::ending_of([&] { lead(arguments, session); }));
    }
    mpi::follow(session, [&] {
        return cli::read_mesh_arguments(cli::parse_arguments(arguments, manual().options));
    });
    return 0;
}

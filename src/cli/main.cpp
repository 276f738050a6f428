#include "cli/commands.h"
#include "cli/exit_code.h"

#include <string>
#include <vector>

int main(int count, char** words)
{
    namespace cli = vcarve::cli;
    cli::open_standard_streams();
    return cli::report(cli::ending_of([&] {
        const std::vector<std::string> arguments(words + (count > 0 ? 1 : 0), words + count);
        cli::run_command_line(arguments, cli::commands());
    }));
}

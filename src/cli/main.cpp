#include "cli/commands.h"
#include "cli/exit_code.h"

#include <string>
#include <vector>

int main(int count, char** words)
{
    using namespace vcarve::cli;
    return report(ending_of([&] {
        const std::vector<std::string> arguments(words + (count > 0 ? 1 : 0), words + count);
        run_command_line(arguments, commands());
    }));
}

#include "cli/commands.h"
#include "vcarve/error.h"

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

namespace {

/// Prints one sentence; allocates nothing, for there may be nothing left.
int fail(int exit_code, const char* form, const char* what = "")
{
    std::fputs("colmap-vcarve: ", stderr);
    std::fprintf(stderr, form, what);
    std::fputs("\n", stderr);
    return exit_code;
}

} // namespace

int main(int count, char** words)
{
    try {
        const std::vector<std::string> arguments(words + (count > 0 ? 1 : 0), words + count);
        vcarve::run_command_line(arguments);
        return 0;
    } catch (const vcarve::UsageError& error) {
        return fail(2, "%s", error.what());
    } catch (const vcarve::InputError& error) {
        return fail(3, "%s", error.what());
    } catch (const std::bad_alloc&) {
        return fail(1, "out of memory");
    } catch (const std::exception& error) {
        return fail(1, "internal error: %s, please report", error.what());
    } catch (...) {
        return fail(1, "internal error of an unknown kind, please report");
    }
}

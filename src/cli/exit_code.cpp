#include "cli/exit_code.h"

#include "base/text.h"
#include "cli/interruption.h"
#include "run/ranks.h"
#include "vcarve/error.h"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

namespace vcarve::cli {

namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): handlers get no arguments
std::atomic<bool> memory_is_short = false;

[[noreturn]] void refuse_memory()
{
    memory_is_short = true;
    throw std::bad_alloc();
}

/// Memory may also be short where no exception may pass, as in the standard library's own.
[[noreturn]] void end_without_exception()
{
    if (!memory_is_short) std::abort();
    remove_unfinished();
    std::fputs("colmap-vcarve: out of memory\n", stderr);
    ::_exit(1);
}

} // namespace

Ending ending_of(const std::function<void()>& main)
{
    std::set_new_handler(refuse_memory);
    std::set_terminate(end_without_exception);
    try {
        main();
        return {};
    } catch (const UsageError& error) {
        return {2, error.what()};
    } catch (const InputError& error) {
        return {3, error.what()};
    } catch (const RankError& error) {
        return {error.exit_code(), error.what()};
    } catch (const std::bad_alloc&) {
        return {1, ""}; // no text, for there may be no memory for it
    } catch (const std::exception& error) {
        return {1, std::string("internal error: ") + error.what() + ", please report"};
    } catch (...) {
        return {1, "internal error of an unknown kind, please report"};
    }
}

int report(const Ending& ending)
{
    if (ending.exit_code == 0) return 0;
    std::fputs("colmap-vcarve: ", stderr);
    std::fputs(ending.sentence.empty() ? "out of memory" : control_free(ending.sentence).c_str(),
               stderr);
    std::fputs("\n", stderr);
    return ending.exit_code;
}

} // namespace vcarve::cli

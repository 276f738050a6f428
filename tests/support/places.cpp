// Only this file knows where it was built, so that a cache of compiled files serves the others
// elsewhere.
#include "support/places.h"

namespace vcarve {

std::filesystem::path fixtures_folder()
{
    return VCARVE_FIXTURES;
}

std::string built_program()
{
    return VCARVE_PROGRAM;
}

std::string failing_calls_library()
{
    return VCARVE_FAILING_CALLS;
}

} // namespace vcarve

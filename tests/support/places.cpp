// Only this file contains paths of the build folder, so a compiler cache can serve all other files
// in another folder.
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

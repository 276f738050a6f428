#include "base/version.h"

#include <CGAL/version.h>
#include <Eigen/Core>
#include <OpenMesh/Core/System/config.h>
#include <fmt/format.h>
#include <git_describe.h> // made while building
#include <tbb/version.h>

namespace vcarve {

Versions versions()
{
    return {.program = VCARVE_VERSION,
            .git = VCARVE_GIT_DESCRIBE,
            .build_type = VCARVE_BUILD_TYPE,
            .compiler = VCARVE_COMPILER,
            .cgal = CGAL_VERSION_STR,
            .openmesh = fmt::format("{}.{}", OM_GET_VER, OM_GET_MAJ),
            .eigen = fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION,
                                 EIGEN_MINOR_VERSION),
            .tbb = TBB_runtime_version()};
}

std::string program_version()
{
    const Versions build = versions();
    return build.git.empty() ? build.program : fmt::format("{} ({})", build.program, build.git);
}

} // namespace vcarve

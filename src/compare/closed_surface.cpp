#include "compare/closed_surface.h"

#include "compare/view_rays.h"
#include "vcarve/error.h"
#include "vcarve/reconstruct.h"

#include <fmt/format.h>

#include <utility>

namespace vcarve {

void add_closed_surface(Reference& reference, Scene model, Log& log)
{
    if (reference.rays.empty()) return;
    Stage stage(log, "closed");
    std::int64_t faces = 0;
    try {
        Options options;
        options.surface.closed = true;
        Log silent;
        const TriMesh closed = reconstruct(std::move(model), options, silent).mesh;
        use_closed_surface(reference, closed);
        faces = static_cast<std::int64_t>(closed.faces.size());
    } catch (const InputError& error) {
        log.note(fmt::format("no closed surface to measure against: {}", error.what()));
    }
    stage.end({{"faces of the closed surface", faces}});
}

} // namespace vcarve

#include "base/index_limit.h"

#include "vcarve/error.h"

#include <fmt/format.h>

namespace vcarve {

void require_indexable(std::uint64_t count, std::uint64_t most, const char* what)
{
    if (count <= most) return;
    throw InputError(
        fmt::format("the model makes {} {}, and 32-bit indices allow {}", count, what, most));
}

} // namespace vcarve

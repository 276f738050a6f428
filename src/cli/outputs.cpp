#include "cli/outputs.h"

#include "vcarve/error.h"

#include <fmt/format.h>

namespace vcarve::cli {

void require_distinct(std::span<const Output> outputs)
{
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (outputs[i].path != outputs[k].path) continue;
            throw UsageError(fmt::format("{} and {} cannot both be written to {}", outputs[i].name,
                                         outputs[k].name, outputs[i].path.string()));
        }
    }
}

} // namespace vcarve::cli

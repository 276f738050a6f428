#pragma once

#include "options/option.h"
#include "vcarve/compare.h"
#include "vcarve/options.h"

namespace vcarve {

/// The heading of options that leave the result as it is: threads, memory.
inline constexpr const char* kRunStage = "Run";

/// What a user can set of a run, or of a comparison; the values are those of `options`.
OptionList options_of(Options& options);
OptionList options_of(CompareOptions& options);

/// Throws UsageError for a value out of its range. For those who fill in the fields themselves;
/// what was typed has been checked.
template <typename AnyOptions>
void validate(AnyOptions options)
{
    check_values(options_of(options));
}

} // namespace vcarve

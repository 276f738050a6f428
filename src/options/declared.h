#pragma once

#include "options/option.h"
#include "vcarve/compare.h"
#include "vcarve/io.h"
#include "vcarve/options.h"

namespace vcarve {

/// The heading of options that leave the result as it is: threads, memory.
inline constexpr const char* kRunStage = "Run";

/// PointsOptions as they are typed.
struct PointsArguments {
    PointsOptions points; ///< except the scanner
    WordOrVector scanner;

    PointsOptions all_points() const;
};

/// The options of a run, of a comparison, and of the choice of points; values are in `options`.
OptionList options_of(Options& options);
OptionList options_of(CompareOptions& options);
OptionList options_of(PointsArguments& arguments);

/// Throws UsageError for a value out of range, for callers that set the fields themselves.
template <typename AnyOptions>
void validate(AnyOptions options)
{
    check_values(options_of(options));
}

} // namespace vcarve

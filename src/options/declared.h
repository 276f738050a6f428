#pragma once

#include "options/option.h"
#include "vcarve/compare.h"
#include "vcarve/io.h"
#include "vcarve/options.h"

namespace vcarve {

/// Heading of options that do not affect the result: threads, memory.
inline constexpr const char* kRunStage = "Run";

/// Heading of dense points, texture and masks.
inline constexpr const char* kPhotoStage = "Photograph";

/// PointsOptions as typed on the command line.
struct PointsArguments {
    PointsOptions points; ///< all but the scanner
    WordOrVector scanner;

    PointsOptions all_points() const;
};

/// The options of a run, a comparison and the choice of points. Values refer to the argument.
OptionList options_of(Options& options);
OptionList options_of(CompareOptions& options);
OptionList options_of(PointsArguments& arguments);

/// The up direction of a mesh file.
Option up_option(WordOrVector& up);

/// Throws UsageError if a value is out of range. For callers that set the fields themselves.
template <typename AnyOptions>
void validate(AnyOptions options)
{
    check_values(options_of(options));
}

} // namespace vcarve

#pragma once

#include "options/option.h"
#include "vcarve/io.h"

namespace vcarve {

/// PointsOptions as they are typed.
struct PointsArguments {
    PointsOptions points; ///< but for the scanner
    WordOrVector scanner;

    PointsOptions all_points() const;
};

/// The options that choose points, under a heading of their own.
OptionList options_of(PointsArguments& arguments);

} // namespace vcarve

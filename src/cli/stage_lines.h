#pragma once

#include "vcarve/log.h"

#include <string>
#include <string_view>

namespace vcarve::cli {

/// What a user reads of a stage: "denoise      2,920 vertices moved within their error (0.27 px)".
struct StageWords {
    std::string name;
    std::string text;
    bool is_shown = true; ///< without --verbose
};

/// The one place that says how the counts of a stage become a line. Of what is said besides, as
/// much follows as 80 columns hold. Stages that are not known here show all their counts.
StageWords stage_words(std::string_view stage, const Counts& counts);

/// "24,310 of 25,784 points (1,102 few views, 372 high error)", all that was counted: the first
/// count is the stage's result; a second one named "of" is what it was taken from; others follow in
/// brackets unless they are 0.
std::string counts_text(const Counts& counts);

/// "fill         512 points added on planes                                 0.03 s"
std::string stage_line(const StageWords& words, double seconds);

} // namespace vcarve::cli

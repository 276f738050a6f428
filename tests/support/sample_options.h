#pragma once

#include "vcarve/option_visitor.h"

#include <cstdint>

namespace vcarve {

enum class Shape { round, flat };
inline constexpr const char* kShapeNames[] = {"round", "flat"};
inline constexpr const char* kPlaceWords[] = {"here", "there"};

/// Options with one of every kind, for tests of what is made from declarations.
struct SampleOptions {
    double angle_deg = 10.5;
    double spacing = 2.0;
    int views = 3;
    bool closed = false;
    bool smooth = true;
    Shape shape = Shape::round;
    std::int64_t memory = 3 << 20;
    WordOrVector place = {};
    RegionChoice part = {};

    void visit(OptionVisitor& options)
    {
        options.stage("First");
        options.number(angle_deg, {.name = "angle",
                                   .unit = "deg",
                                   .help = "Drop smaller angles; 0 keeps all.",
                                   .max = 180.0});
        options.number(spacing, {.name = "spacing", .help = "A pure number."});
        options.stage("Second");
        options.count(views,
                      {.name = "min-views", .unit = "views", .help = "Drop points.", .min = 2});
        options.flag(closed, {.name = "closed", .help = "Keep a|b."});
        options.flag(smooth, {.name = "smooth", .help = "Leave corners as they are."});
        options.choice(shape, kShapeNames, {.name = "shape", .help = "What it is like."});
        options.bytes(memory, {.name = "memory", .help = "Take no more."});
        options.word_or_vector(
            place, kPlaceWords,
            {.name = "place", .help = "Where it is.", .min = -10.0, .max = 10.0});
        options.region(part, {.name = "part", .help = "How much."});
    }
};

} // namespace vcarve

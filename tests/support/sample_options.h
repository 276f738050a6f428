#pragma once

#include "options/option.h"

#include <cstdint>

namespace vcarve {

enum class Shape { round, flat };

/// Options of every kind, for tests of the code that reads declarations.
struct SampleOptions {
    double angle_deg = 10.5;
    double spacing = 2.0;
    int views = 3;
    bool closed = false;
    Shape shape = Shape::round;
    std::int64_t memory = 3 << 20;
    WordOrVector place = {};
    RegionChoice part = {};
    double factor = 7.0;
    int secret = 1;
};

inline OptionList options_of(SampleOptions& options)
{
    return {
        {"First",
         {.name = "angle",
          .unit = "deg",
          .help = "Drop smaller angles; 0 keeps all.",
          .max = 180.0},
         &options.angle_deg},
        {"First", {.name = "spacing", .help = "A pure number."}, &options.spacing},
        {"Second",
         {.name = "min-views", .unit = "views", .help = "Drop points.", .min = 2},
         &options.views},
        {"Second", {.name = "closed", .help = "Keep a|b."}, &options.closed},
        {"Second",
         {.name = "shape", .help = "What it is like.", .words = {"round", "flat"}},
         value_of_enum(options.shape)},
        {"Second", {.name = "memory", .help = "Take no more."}, &options.memory},
        {"Second",
         {.name = "place",
          .help = "Where it is.",
          .min = -10.0,
          .max = 10.0,
          .words = {"here", "there"}},
         &options.place},
        {"Second", {.name = "part", .help = "How much.", .words = {"none", "auto"}}, &options.part},
        {"Third",
         {.name = "factor",
          .help = "Of what is usual.",
          .words = {"usual"},
          .word_value = 1.0,
          .level = OptionLevel::advanced},
         &options.factor},
        {"Third",
         {.name = "secret", .help = "For C++.", .level = OptionLevel::library},
         &options.secret},
    };
}

} // namespace vcarve

#include "options/points_arguments.h"

namespace vcarve {

PointsOptions PointsArguments::all_points() const
{
    PointsOptions all = points;
    if (scanner.word == WordOrVector::kNoWord) all.scanner = scanner.vector;
    return all;
}

OptionList options_of(PointsArguments& arguments)
{
    constexpr const char* kStage = "Input";
    return {
        {kStage,
         {.name = "points",
          .unit = "file",
          .help = "Which points to take: sparse, those of the model; dense, those of fused.ply in "
                  "a dense workspace; or a PLY file with points in the model's frame. By default "
                  "the dense ones where fused.ply and fused.ply.vis are there.",
          .words = {"sparse", "dense"}},
         &arguments.points.points},
        {kStage,
         {.name = "visibility",
          .help = "Which views saw the points of a PLY file, as COLMAP's stereo_fusion writes it; "
                  "by default the file called like it and .vis.",
          .tuning = true},
         &arguments.points.visibility},
        {kStage,
         {.name = "sights",
          .help = "Which views saw the points. file: as the model's tracks or the file of "
                  "--visibility say. nearest: that is not known; the nearest views are taken "
                  "before which no other point stands. auto: as file, and as nearest where most "
                  "points of a model have fewer than two views.",
          .words = {"auto", "file", "nearest"}},
         value_of_enum(arguments.points.sights)},
        {kStage,
         {.name = "scanner",
          .help = "Where the laser scanner stood that measured all points of a PLY file, in its "
                  "coordinates; then no model is needed. file: as it tells itself, for every point "
                  "(x_origin, y_origin, z_origin, or scanner_x ...) or once (PCL's element "
                  "camera).",
          .min = -kUnlimited,
          .words = {"file"}},
         &arguments.scanner},
    };
}

} // namespace vcarve

#pragma once

#include "base/progress.h"
#include "cli/run_record.h"
#include "io/input/read_model.h"
#include "model/similarity.h"
#include "options/declared.h"
#include "options/option.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace vcarve::cli {

/// The operand MODEL and the options that choose its points.
struct ModelArguments : PointsArguments {
    std::filesystem::path path;
};

/// A file that a command writes or reads, and its name in messages.
struct Output {
    const char* name;
    std::filesystem::path path;
};

/// How much is printed, and how many threads work.
struct ConsoleArguments {
    bool quiet = false;
    bool verbose = false;
    int threads = 0; ///< 0: all
};

/// --quiet, with its help, --verbose and --threads, under the heading "Run".
OptionList options_of(ConsoleArguments& arguments, const char* quiet_help);

/// Throws UsageError if two outputs would be one file.
void require_distinct(std::span<const Output> outputs);

/// Throws UsageError if an output would replace a file of the input, by any path or link: one of
/// input_files(), an image of the views, or one of `others`. Throws InputError as find_input()
/// does. Costs nothing if no output exists yet.
void keep_inputs(std::span<const Output> outputs, const ModelArguments& model,
                 std::span<const Output> others);

/// Reports errors of outputs before the work starts: throws UsageError. A run that fails or is
/// ended by a signal leaves no partial file, and no folder `scratch`, if one is given.
void prepare_outputs(std::span<const Output> outputs, const std::filesystem::path& scratch = {});

/// A model and its record.
struct ModelInput {
    Scene scene;
    SceneSize read;                   ///< before points were merged
    bool takes_nearest_views = false; ///< see FoundInput
    Json record; ///< "model", "folder", "format", "cloud", "points", "views", "sights"
};

/// Finds and reads a model, as the stage "read". Throws InputError.
ModelInput read_model_input(const ModelArguments& model, Log& log, const Reading& reading = {});

enum class OffsetWord { none, automatic };
/// What is up: as the cameras stand (up_of), where they look back to, z of what is written, or not
/// to be asked.
enum class UpWord { automatic, back, z, none };

/// What the value of --transform says, a scale or a file, from the frame of the model; nothing of
/// an empty one. Throws UsageError of a number that is no scale, and InputError as read_sim3(),
/// read_nerfstudio_transform() and find_input() do.
std::optional<Similarity> transform_of(const std::string& text, const ModelArguments& model);

/// What --offset says is to be subtracted from what is written of a model, once that is
/// transformed. The words are those of OffsetWord.
Eigen::Vector3d offset_for(const Scene& model, const WordOrVector& wanted,
                           const std::optional<Similarity>& transform);

/// What points up in what is written of a model, once that is transformed; zero of UpWord::none.
/// The words are those of UpWord. Throws UsageError for a vector without length.
Eigen::Vector3d up_for(const Scene& model, const WordOrVector& wanted,
                       const std::optional<Similarity>& transform);

/// `transform`, and then a rotation that turns `up` to z.
Similarity turned_upright(const std::optional<Similarity>& transform, const Eigen::Vector3d& up);

/// A surface in another frame.
TriMesh transformed(TriMesh mesh, const Similarity& to);

} // namespace vcarve::cli

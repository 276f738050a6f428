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

/// The verbosity and the thread count.
struct ConsoleArguments {
    bool quiet = false;
    bool verbose = false;
    int threads = 0; ///< 0 uses all
};

/// --quiet (with its help), --verbose and --threads, under the heading "Run".
OptionList options_of(ConsoleArguments& arguments, const char* quiet_help);

/// Throws UsageError if two outputs are the same file.
void require_distinct(std::span<const Output> outputs);

/// Throws UsageError if an output would replace a file of the input, by any path or link. These
/// files are input_files(), the images of the views, and `others`. Throws InputError as
/// find_input(). Costs nothing if no output exists yet.
void keep_inputs(std::span<const Output> outputs, const ModelArguments& model,
                 std::span<const Output> others);

/// Throws UsageError if an output cannot be written; call it before the work starts. A run that
/// fails or is ended by a signal then leaves no partial file, and no folder `scratch` if given.
void prepare_outputs(std::span<const Output> outputs, const std::filesystem::path& scratch = {});

/// A model and its record.
struct ModelInput : ReadModel {
    Json record; ///< "model", "folder", "format", "cloud", "points", "views", "rays"
};

/// Finds and reads a model, as the stage "read". Throws InputError.
ModelInput read_model_input(const ModelArguments& model, Log& log, const Reading& reading = {});

enum class OffsetWord { none, automatic };
/// The up direction: that of most cameras (up_of), the direction opposite to their view (back_of),
/// z of the output, or unknown.
enum class UpWord { automatic, back, z, none };

/// The transformation of --transform, a scale or a file, from the frame of the model; nothing if
/// `text` is empty. Throws UsageError if a number is not a valid scale, and InputError as
/// read_sim3(), read_nerfstudio_transform() and find_input().
std::optional<Similarity> transform_of(const std::string& text, const ModelArguments& model);

/// The offset of --offset, to be subtracted from coordinates after `transform`. The words are those
/// of OffsetWord.
Eigen::Vector3d offset_for(const Scene& model, const WordOrVector& wanted,
                           const std::optional<Similarity>& transform);

/// The up direction of --up in coordinates after `transform`; zero for UpWord::none. The words are
/// those of UpWord. Throws UsageError if the vector is zero.
Eigen::Vector3d up_for(const Scene& model, const WordOrVector& wanted,
                       const std::optional<Similarity>& transform);

/// `transform`, followed by a rotation of `up` to z.
Similarity turned_upright(const std::optional<Similarity>& transform, const Eigen::Vector3d& up);

/// Transforms positions and normals of a mesh.
TriMesh transformed(TriMesh mesh, const Similarity& to);

} // namespace vcarve::cli

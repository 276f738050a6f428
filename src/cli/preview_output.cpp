#include "cli/preview_output.h"

#include "base/lower_case_end.h"
#include "picture/eye.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <array>

namespace vcarve::cli {

namespace {

constexpr std::array<const char*, 3> kViewWords = {"auto", "top", "orbit"};

} // namespace

void list_preview_options(OptionTable& table)
{
    table.path({.name = "preview",
                .help = "Also draw the surface, as PNG: in its colours, backs of faces in magenta, "
                        "beside its normals as colours."});
    table.word_or_name(
        kViewWords,
        {.name = "view",
         .help =
             "From where --preview looks. auto: through the camera of the image that sees most of "
             "what was looked at. top, orbit: from outside, above or obliquely, through the "
             "backs of walls; up is the mean of the cameras'. Else the image of that name."});
}

PreviewArguments read_preview_options(const ParsedArguments& given)
{
    PreviewArguments arguments;
    if (given.has("view") && !given.has("preview")) {
        throw UsageError("--view says from where --preview looks, but there is no --preview");
    }
    if (!given.has("preview")) return arguments;
    arguments.out = given.options.at("preview");
    if (lower_case_end(arguments.out) != ".png") {
        throw UsageError(fmt::format("cannot write {}: the name of a picture must end with .png",
                                     arguments.out.string()));
    }
    if (given.has("view")) arguments.view = given.options.at("view");
    return arguments;
}

void PreviewOutput::stand_in(const Scene& scene)
{
    if (!arguments_.out.empty()) preview_.emplace(choose_eye(scene, arguments_.view));
}

void PreviewOutput::add(const std::string& name, const TriMesh& mesh, Log& log)
{
    if (!preview_) return;
    Stage stage(log, "preview");
    const std::int64_t pixels = preview_->add(name, mesh);
    is_empty_ = false;
    stage.end({{"pixels of " + name, pixels}});
}

void PreviewOutput::write()
{
    if (!preview_) return;
    if (is_empty_) preview_->add("no surface", {});
    write_png(arguments_.out, preview_->picture());
}

Json PreviewOutput::record() const
{
    if (!preview_) return nullptr;
    return {{"file", arguments_.out.string()}, {"view", preview_->eye().name}};
}

} // namespace vcarve::cli

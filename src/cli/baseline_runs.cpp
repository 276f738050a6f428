#include "cli/baseline_runs.h"

#include "cli/run_record.h"
#include "io/input/find_input.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

namespace vcarve::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kColmap = "COLMAP";
constexpr const char* kOurs = "colmap-vcarve";

/// A program to run. It writes NAME.ply, and its output is in NAME.txt.
struct Program {
    std::string name;    ///< of the column
    std::string program; ///< for messages
    std::vector<std::string> words;
    double timeout_s = kUnlimited;
};

fs::path mesh_path(const fs::path& folder, const std::string& name)
{
    return folder / (name + ".ply");
}

fs::path printed_path(const fs::path& folder, const std::string& name)
{
    return folder / (name + ".txt");
}

/// The input folder of COLMAP's mesher, which finds dense points by fixed names in one folder.
fs::path colmap_input(const FoundInput& input)
{
    if (input.scan) {
        throw UsageError(fmt::format("--colmap cannot use the points of {}: COLMAP's mesher does "
                                     "not support laser scans",
                                     input.scan->cloud.string()));
    }
    if (!input.dense) return input.model.folder;
    fs::path workspace = "." / input.dense->cloud.parent_path();
    const auto is_at = [&](const fs::path& path, const char* name) {
        return path.lexically_normal() == (workspace / name).lexically_normal();
    };
    const bool is_workspace = is_at(input.dense->cloud, "fused.ply") &&
                              is_at(input.dense->visibility, "fused.ply.vis") &&
                              is_at(input.dense->model, "sparse");
    if (is_workspace) return workspace;
    throw UsageError(fmt::format("--colmap cannot use the points of {}: COLMAP's mesher reads "
                                 "fused.ply, fused.ply.vis and sparse from one folder",
                                 input.dense->cloud.string()));
}

Program colmap_baseline(const BaselineRun& run, const FoundInput& input, const fs::path& folder)
{
    Program baseline{.name = kColmap,
                     .program = run.colmap,
                     .words = {run.colmap, "delaunay_mesher", "--input_type",
                               input.dense ? "dense" : "sparse", "--input_path",
                               colmap_input(input).string(), "--output_path",
                               mesh_path(folder, kColmap).string()},
                     .timeout_s = static_cast<double>(run.options.timeout_s)};
    if (run.threads > 0) {
        baseline.words.insert(baseline.words.end(),
                              {"--DelaunayMeshing.num_threads", std::to_string(run.threads)});
    }
    return baseline;
}

Program own_baseline(const BaselineRun& run, const FoundInput& input, const fs::path& folder)
{
    Program baseline{.name = kOurs,
                     .program = kOurs,
                     .words = {"/proc/self/exe", "--quiet", "--threads",
                               std::to_string(run.threads), "--points"}};
    if (input.dense) {
        const fs::path& visibility = input.dense->visibility;
        baseline.words.push_back(input.dense->cloud.string());
        baseline.words.emplace_back(visibility.empty() ? "--rays" : "--visibility");
        baseline.words.push_back(visibility.empty() ? "nearest" : visibility.string());
    } else {
        baseline.words.emplace_back("sparse");
    }
    baseline.words.insert(baseline.words.end(),
                          {"--", input.model.folder.string(), mesh_path(folder, kOurs).string()});
    return baseline;
}

std::string bytes_of(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string last_line(const std::string& text)
{
    const std::size_t end = text.find_last_not_of(" \n\r\t");
    if (end == std::string::npos) return "";
    const std::size_t begin = text.find_last_of('\n', end) + 1; // npos + 1 is 0
    return text.substr(begin, end + 1 - begin);
}

/// One sentence with the reason why the program made no mesh.
std::string why_no_mesh(const Program& baseline, const ChildOutcome& outcome,
                        const std::string& printed)
{
    if (printed.find("requires CGAL") != std::string::npos) {
        return fmt::format("{} was built without CGAL, so it has no Delaunay mesher; its column is "
                           "omitted",
                           baseline.program);
    }
    const std::string line = last_line(printed);
    return fmt::format("{} {} and wrote no mesh{}; its column is omitted", baseline.program,
                       outcome.description, line.empty() ? "" : ", its last output: " + line);
}

/// Adds a column without its mesh: this process must stay small until all baselines have run.
void run_program(const Program& baseline, const fs::path& folder, std::vector<BaselineMesh>& meshes,
                 Log& log)
{
    Stage stage(log, baseline.name);
    const fs::path printed = printed_path(folder, baseline.name);
    const ChildOutcome outcome = run_child(baseline.words, printed, baseline.timeout_s);
    stage.end({});
    if (outcome.timed_out) {
        meshes.push_back({.name = baseline.name,
                          .failure = fmt::format("timed out after {} s", baseline.timeout_s),
                          .mesh = {},
                          .cost = outcome.cost});
    } else if (outcome.succeeded && fs::exists(mesh_path(folder, baseline.name))) {
        meshes.push_back({.name = baseline.name, .failure = "", .mesh = {}, .cost = outcome.cost});
    } else {
        log.note(why_no_mesh(baseline, outcome, bytes_of(printed)));
    }
}

using Clock = std::chrono::steady_clock;

constexpr int kNotStarted = 127; ///< exit code, as in shells
constexpr std::chrono::milliseconds kPollInterval(2);

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Starts the program in the child. Between fork and exec, only async-signal-safe calls are
/// allowed.
[[noreturn]] void become(char** words, const char* printed)
{
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    ::signal(SIGPIPE, SIG_DFL);
    ::signal(SIGXFSZ, SIG_DFL);
    const int nothing = ::open("/dev/null", O_RDONLY);
    const int out = ::open(printed, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const bool ready = nothing >= 0 && out >= 0 && ::dup2(nothing, STDIN_FILENO) >= 0 &&
                       ::dup2(out, STDOUT_FILENO) >= 0 && ::dup2(out, STDERR_FILENO) >= 0;
    if (ready) ::execvp(words[0], words);
    ::_exit(kNotStarted);
}

std::string description_of(int status)
{
    if (WIFSIGNALED(status)) return fmt::format("was killed by signal {}", WTERMSIG(status));
    if (WEXITSTATUS(status) == kNotStarted) return "could not be started";
    return fmt::format("exited with code {}", WEXITSTATUS(status));
}

/// Waits for the child. Returns whether it was killed because of the timeout.
bool wait_or_kill(pid_t child, double timeout_s, int& status, rusage& usage)
{
    const Clock::time_point start = Clock::now();
    while (::wait4(child, &status, WNOHANG, &usage) == 0) {
        if (seconds_since(start) > timeout_s) {
            ::kill(-child, SIGKILL);
            ::wait4(child, &status, 0, &usage);
            return true;
        }
        std::this_thread::sleep_for(kPollInterval);
    }
    return false;
}

} // namespace

ScratchFolder::ScratchFolder()
{
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    std::string pattern = (parent / "colmap-vcarve-XXXXXX").string();
    if (error || ::mkdtemp(pattern.data()) == nullptr) {
        throw UsageError(fmt::format("cannot create a temporary folder in {}", parent.string()));
    }
    path_ = pattern;
}

ScratchFolder::~ScratchFolder()
{
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::vector<BaselineMesh> run_baselines(const BaselineRun& run, const ScratchFolder& scratch,
                                        Log& log)
{
    const FoundInput& input = run.found;
    std::vector<BaselineMesh> meshes;
    run_program(colmap_baseline(run, input, scratch.path()), scratch.path(), meshes, log);
    run_program(own_baseline(run, input, scratch.path()), scratch.path(), meshes, log);
    for (BaselineMesh& baseline : meshes) {
        if (baseline.failure.empty())
            baseline.mesh = read_ply(mesh_path(scratch.path(), baseline.name));
    }
    return meshes;
}

ChildOutcome run_child(std::vector<std::string> words, const std::filesystem::path& printed,
                       double timeout_s)
{
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) {
        pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);

    const Clock::time_point start = Clock::now();
    ::signal(SIGCHLD, SIG_DFL); // if a caller ignores it, the system drops the exit code
    const pid_t child = ::fork();
    if (child < 0) throw UsageError("cannot start another process");
    if (child == 0) become(pointers.data(), printed.c_str());
    ::setpgid(child, child); // the child does this, too; the first call counts

    ChildOutcome outcome;
    int status = 0;
    rusage usage = {};
    outcome.timed_out = wait_or_kill(child, timeout_s, status, usage);
    outcome.cost = {.seconds = seconds_since(start),
                    .cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime),
                    .peak_memory_bytes = 1024 * static_cast<std::int64_t>(usage.ru_maxrss)};
    outcome.succeeded = !outcome.timed_out && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    outcome.description = description_of(status);
    return outcome;
}

} // namespace vcarve::cli

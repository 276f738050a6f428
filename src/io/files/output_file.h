#pragma once

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <streambuf>
#include <string_view>
#include <vector>

namespace vcarve {

/// The temporary file for `path`: "OUT.ply.part-PID" in the same folder, so that the final rename
/// stays within one file system. The name is constant while the process lives, so a signal handler
/// can receive it in advance for unlinking.
std::filesystem::path part_path(const std::filesystem::path& path);

/// Throws UsageError with one sentence if `path` cannot be written: it is empty, a folder or a
/// write-protected file, or its folder is missing or accepts no new file. Leaves no file behind.
void require_writable(const std::filesystem::path& path);

/// Writes to the standard output. Throws UsageError if it cannot write all of `text`.
void print(std::string_view text);

/// Writes a file completely or not at all. The stream writes to part_path(path), commit() renames
/// that file, and the destructor removes it if commit() was not called. The permissions of a
/// replaced file are kept. A character device (/dev/null, /dev/stdout) cannot be replaced, so it is
/// written directly. Precondition: at most one object per path at a time.
class OutputFile {
  public:
    /// Throws UsageError like require_writable().
    explicit OutputFile(std::filesystem::path path);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    ~OutputFile();

    std::ostream& stream() { return stream_; }

    /// Syncs the file to the disk, then renames it. Throws UsageError if the disk is full or any
    /// write failed; then no new file is left behind. Call it once, last.
    void commit();

  private:
    /// A buffer in front of a file descriptor; stores the first error.
    class Sink : public std::streambuf {
      public:
        Sink();
        void write_to(int descriptor) { descriptor_ = descriptor; }
        int error() const { return error_; }
        bool flush();

      protected:
        int_type overflow(int_type byte) override;
        std::streamsize xsputn(const char* bytes, std::streamsize count) override;
        int sync() override { return flush() ? 0 : -1; }

      private:
        bool write_all(const char* bytes, std::size_t count);

        int descriptor_ = -1;
        int error_ = 0;
        std::vector<char> buffer_;
    };

    std::filesystem::path path_;   ///< as the user wrote it, for messages
    std::filesystem::path target_; ///< the file to replace, symbolic links resolved
    std::filesystem::path part_;   ///< empty if the target is written directly
    Sink sink_;
    std::ostream stream_;
    int descriptor_; ///< opened last, so that an earlier std::bad_alloc leaves no temporary file
};

} // namespace vcarve

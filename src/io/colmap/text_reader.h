#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace vcarve {

/// `text`, fit to stand in a message: cut where it is long, control characters replaced.
std::string printable(std::string_view text);

/// A cursor over the words of a text file, line by line. Lines end in LF or CR LF, words are set
/// apart by blanks and tabs, a line that begins with # is a comment. Numbers are read in the C
/// locale, whatever the user's. All that fails throws InputError naming the file and the line;
/// `what` is how the message calls what was to be read.
class TextReader {
  public:
    /// `bytes` must outlive the reader; `name` is how messages call the file.
    TextReader(std::span<const char> bytes, std::string name);

    /// Goes to the next line that is not a comment, though it may be blank. False: there is none.
    bool next_line();
    /// Goes to the next line that is neither a comment nor blank. False: there is none.
    bool next_record();

    /// How many bytes of the file are read, with all of the current line.
    std::size_t offset() const { return size_ - unread_.size(); }
    /// How much of the file is read, 0 to 1.
    double share_read() const
    {
        return 1.0 - static_cast<double>(unread_.size()) / static_cast<double>(size_);
    }

    /// Whether all words of the line are read.
    bool at_line_end();
    /// The words of the line not read yet, as they stand, without the blanks around them.
    std::string_view rest();

    std::string_view read_word(const char* what);
    double read_double(const char* what);
    std::uint8_t read_uint8(const char* what);
    std::uint32_t read_uint32(const char* what);
    std::uint64_t read_uint64(const char* what);
    /// The same; a negative one, which stands for none, is the largest number of the type.
    std::uint32_t read_uint32_or_none(const char* what);
    std::uint64_t read_uint64_or_none(const char* what);

    /// Throws: "NAME: line N: sentence".
    [[noreturn]] void fail(const std::string& sentence) const;

  private:
    template <typename T>
    T read_number(const char* what, const char* kind);
    bool take_none();

    std::string_view unread_; ///< the file after the current line
    std::string_view line_;   ///< what is left of the current line
    std::size_t size_;
    std::size_t line_number_ = 0;
    std::string name_;
};

} // namespace vcarve

#pragma once

/// \file examples/common/command_line.hpp
/// \brief The command line that all example programs share.
///
/// CLI11 does the work in command_line.cpp, which is compiled once: its header takes
/// longer to compile than a whole chapter.

#include <charconv>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "signals.hpp"

namespace examples {

/// The trade between time and quality of a picture.
enum class Quality {
    draft,    ///< A second or so: does it work?
    report,   ///< As in the report.
    reference ///< As accurate as is practical.
};

/// The size of a picture and the rays per pixel.
struct Frame {
    int width = 400;  ///< In pixels; 0: taken from a file, by fill().
    int height = 400; ///< In pixels; 0: taken from a file, by fill().
    int samples = 64; ///< Rays per pixel.
};

/// The frame of each quality in a program; options given by name override it.
struct Presets {
    Frame draft{.width = 100, .height = 100, .samples = 4};   ///< --quality draft
    Frame report{.width = 400, .height = 400, .samples = 64}; ///< --quality report
    Frame reference{
        .width = 400, .height = 400, .samples = 1024}; ///< --quality reference
};

/// The options that all programs share.
struct Options {
    std::string out = ".";             ///< --out: the folder of all files; it exists.
    std::string file;                  ///< The file's name, if --out named a file.
    Quality quality = Quality::report; ///< --quality
    std::uint64_t seed = 1;            ///< --seed
    int threads = 0;                   ///< --threads; 0: one per processor.
    int width = 0;                     ///< --width, in pixels.
    int height = 0;                    ///< --height, in pixels.
    int samples = 0;                   ///< --rays, per pixel.
    bool quiet = false; ///< --quiet: no progress bar, no text but remarks.
    std::string only;   ///< --only, in a program that makes several items.

    /// Whether an item is to be made: --only names it, or is not given.
    [[nodiscard]] bool wants(const std::string& item) const {
        return only.empty() || only == item;
    }

    /// The path of a file in the folder.
    /// \param name  Name of the file, as "ch04_sphere.png".
    /// \throws Interrupted  after Ctrl-C, so that no unfinished picture is saved.
    [[nodiscard]] std::string path(const std::string& name) const;

    /// The value for the chosen quality.
    template <typename Value>
    [[nodiscard]] Value pick(Value draft, Value report, Value reference) const {
        if (quality == Quality::draft) return draft;
        return quality == Quality::report ? report : reference;
    }
};

/// Words, and the value of each.
template <typename Value>
using Words = std::vector<std::pair<std::string, Value>>;

// The compiler's name for this function, which holds that of the enumerator, or a
// number if there is none.
template <auto value>
[[nodiscard]] const char* spelled() {
#ifdef _MSC_VER
    return __FUNCSIG__;
#else
    return __PRETTY_FUNCTION__;
#endif
}

// "multi-jittered" from "... value = ljus::Sampling::multi_jittered]"; empty for a
// number.
[[nodiscard]] std::string word_in(const std::string& spelled);

/// The words of an enum: its enumerators, with - for _, taken from the compiler so that
/// no list must be kept in step by hand.
/// \tparam Enum   An enum class with enumerators from 0 on, at most 16.
/// \tparam Value  Enum, or a std::optional of it.
template <typename Enum, typename Value = Enum>
[[nodiscard]] Words<Value> words_of() {
    Words<Value> words;
    [&words]<int... i>(std::integer_sequence<int, i...>) {
        (words.emplace_back(word_in(spelled<static_cast<Enum>(i)>()),
                            static_cast<Enum>(i)),
         ...);
    }
    (std::make_integer_sequence<int, 16>{});
    std::erase_if(words, [](const auto& word) { return word.first.empty(); });
    return words;
}

/// A number, not bool.
template <typename T>
concept ANumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// An enum.
template <typename T>
concept AnEnum = std::is_enum_v<T>;

/// Any type but text.
template <typename T>
concept NoText = !std::is_same_v<T, std::string>;

/// The command line of one program: add its own options, then call parse().
///
/// An option is a setting that the program states in one call: its name, the member
/// that holds its value, one line of help, and the values that it takes. --help shows
/// all of that, and values() returns the final value of each setting.
class CommandLine {
public:
    /// \param arguments  The program's name and what follows it.
    explicit CommandLine(std::vector<std::string> arguments);
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;
    ~CommandLine();

    /// One sentence at the top of --help.
    void about(const std::string& text);

    /// Begins a group of --help, which holds the options that are added from here on.
    /// \param heading  As "Photons".
    /// \param shared   Shared options to list in this group as well, as "--seed".
    void group(const std::string& heading, const std::vector<std::string>& shared = {});

    /// An option with a number, or a whole number below 2^53; `value` holds the
    /// default, and must live as long as the command line. A default outside the range
    /// means "none".
    /// \param name     As "--radius".
    /// \param value    The default, and then what the user gave.
    /// \param help     One line.
    /// \param least    The least value that is allowed.
    /// \param most     The largest value that is allowed.
    /// \param or_zero  Whether 0 is allowed as well.
    template <ANumber Number>
    void add(const std::string& name, Number& value, const std::string& help,
             double least, double most, bool or_zero = false) {
        const auto read = [&value] {
            char text[32];
            return std::string(&text[0],
                               std::to_chars(text, text + sizeof text, value).ptr);
        };
        add_number(name, help, std::is_integral_v<Number>, least, most, or_zero, read,
                   [&value](double given) { value = static_cast<Number>(given); });
    }
    /// One of several values, each chosen by a word; a value without a word may be the
    /// default, but cannot be chosen.
    template <NoText Value>
    void add(const std::string& name, Value& value, const std::string& help,
             const Words<Value>& words) {
        std::vector<std::string> names;
        for (const auto& word : words) names.push_back(word.first);
        const auto read = [&value, words] {
            std::size_t i = 0;
            while (i < words.size() && !(words[i].second == value)) ++i;
            return i;
        };
        add_words(name, help, names, read,
                  [&value, words](std::size_t i) { value = words[i].second; });
    }
    /// One of the enumerators of an enum.
    template <AnEnum Enum>
    void add(const std::string& name, Enum& value, const std::string& help) {
        add(name, value, help, words_of<Enum>());
    }
    /// The same, or none of them if the option is not given.
    template <typename Enum>
    void add(const std::string& name, std::optional<Enum>& value,
             const std::string& help) {
        add(name, value, help, words_of<Enum, std::optional<Enum>>());
    }
    /// A word from a list, or any text if the list is empty; the name may then say what
    /// kind of text, as "--checkpoint FILE".
    void add(const std::string& name, std::string& value, const std::string& help,
             const std::vector<std::string>& words = {});
    /// One or more words: all that follow up to the next option.
    void add(const std::string& name, std::vector<std::string>& values,
             const std::string& help);
    /// A switch: false unless it is given.
    void add(const std::string& name, bool& value, const std::string& help);

    /// A switch that prints a text and ends the program, whatever else is given.
    void prints(const std::string& name, const std::string& help,
                std::function<std::string()> text);

    /// The report's items that the program makes, as "fig-5"; --only chooses one of
    /// them.
    void makes(const std::vector<std::string>& items);

    /// A positional argument, which must be given.
    /// \param name   Its name in --help.
    /// \param value  Receives what the user gave.
    /// \param help   One line.
    void add_positional(const std::string& name, std::string& value,
                        const std::string& help);
    /// Lets --out name a file of one of these types, or a folder for one; parse()
    /// neither creates nor checks it: see require_writable().
    /// \param types  As ".png".
    void file_types(const std::vector<std::string>& types);

    /// Removes options that have no meaning for this program.
    /// \param names  Names of shared options, as "--seed".
    void without(const std::vector<std::string>& names);

    /// Whether the user gave this option, so that its value is not the default.
    [[nodiscard]] bool given(const std::string& name) const;

    /// The names of all options that were given, as "--seed".
    [[nodiscard]] std::vector<std::string> all_given() const;

    /// The heading of the group to which an option belongs; empty if there is none.
    [[nodiscard]] std::string group_of(const std::string& name) const;

    /// The current value of each setting of a group, by its name, as "seed", in JSON.
    /// Free texts, such as names of files, are left out, and so are words that were not
    /// chosen.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>>
    values(const std::string& heading) const;

    /// Reads the command line, creates the folder for the files, and tests that it can
    /// be written, before any work could be lost.
    /// \param presets  The frame of each quality.
    /// \throws Exit  for --help and --version, which have printed their text.
    /// \throws std::invalid_argument  for a wrong command line.
    /// \throws std::runtime_error     for a folder that cannot be used.
    [[nodiscard]] Options parse(const Presets& presets = {});

    /// Sets the size and the rays, where the user gave none, to those of a file or to
    /// values chosen after parse().
    /// \param frame  Size and rays.
    /// \return All options.
    Options fill(const Frame& frame);

    /// Sets the user's values again, after a preset has overwritten them.
    void give_again();

private:
    struct Parser;
    // The templates call these: `read` returns the value, and `take` sets it.
    void add_number(const std::string& name, const std::string& help, bool whole,
                    double least, double most, bool or_zero,
                    std::function<std::string()> read,
                    std::function<void(double)> take);
    // Words are numbered; a number past the last stands for none.
    void add_words(const std::string& name, const std::string& help,
                   const std::vector<std::string>& words,
                   std::function<std::size_t()> read,
                   std::function<void(std::size_t)> take);
    std::unique_ptr<Parser> parser_;
};

/// Checks that a file can be written, before any work could be lost; creates its folder
/// if it is missing.
/// \param path  The file; an existing one is not changed.
/// \throws std::runtime_error  with the path and the reason.
void require_writable(const std::string& path);

/// The two numbers of "120,80" or "3/16".
/// \param text     What the user gave.
/// \param between  The character between them.
/// \return Two whole numbers; nothing if the text has another form.
[[nodiscard]] std::optional<std::pair<int, int>> two_numbers(const std::string& text,
                                                             char between);

/// Ends a program with this code; run_main() returns it.
struct Exit {
    int code = 0; ///< 0 for success, 2 for wrong usage.
};

/// The main() of an example program.
///
///     int main(int argc, char** argv) {
///         return examples::run_main(argc, argv, [](examples::CommandLine& line) {
///             const examples::Options options = line.parse();
///             ...
///         });
///     }
///
/// \return 0; after an exception 2, with one sentence on stderr; after Ctrl-C 130 (128
///         plus the signal).
int run_main(int argc, const char* const* argv,
             const std::function<void(CommandLine&)>& body);

} // namespace examples

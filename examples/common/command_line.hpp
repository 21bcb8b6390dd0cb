#pragma once

/// \file examples/common/command_line.hpp
/// \brief The command line that all example programs share.
///
/// The work is done by CLI11, in command_line.cpp. Only that file includes CLI11, whose
/// header takes longer to compile than a whole chapter.

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
    draft,    ///< A first look, in about a second.
    report,   ///< The quality of the report's pictures.
    reference ///< As accurate as is practical.
};

/// The size of a picture and the rays per pixel.
struct Frame {
    int width = 400;  ///< In pixels; 0 until fill() sets it.
    int height = 400; ///< In pixels; 0 until fill() sets it.
    int samples = 64; ///< Rays per pixel.
};

/// The frame of each quality in a program. The options --width, --height and --rays
/// override it.
struct Presets {
    Frame draft{.width = 100, .height = 100, .samples = 4};   ///< --quality draft
    Frame report{.width = 400, .height = 400, .samples = 64}; ///< --quality report
    Frame reference{
        .width = 400, .height = 400, .samples = 1024}; ///< --quality reference
};

/// The options that all programs share.
struct Options {
    std::string out = "."; ///< --out: the folder for all files, which exists.
    std::string file;      ///< The name of the file, if --out named one.
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
    /// \param name  Name of the file, such as "fig-9.svg".
    /// \throws Interrupted  after Ctrl-C, so that no unfinished picture is saved.
    [[nodiscard]] std::string path(const std::string& name) const;

    /// The value for the chosen quality.
    template <typename Value>
    [[nodiscard]] Value pick(Value draft, Value report, Value reference) const {
        if (quality == Quality::draft) return draft;
        return quality == Quality::report ? report : reference;
    }
};

/// A list of words, each with its value.
template <typename Value>
using Words = std::vector<std::pair<std::string, Value>>;

// The name that the compiler gives this function. It contains the name of the
// enumerator, or a number if there is no such enumerator.
template <auto value>
[[nodiscard]] const char* spelled() {
#ifdef _MSC_VER
    return __FUNCSIG__;
#else
    return __PRETTY_FUNCTION__;
#endif
}

// The word "multi-jittered" from "... value = ljus::Sampling::multi_jittered]"; empty
// if the text ends with a number.
[[nodiscard]] std::string word_in(const std::string& spelled);

/// The words of an enum: its enumerators, with - for _. The names come from the
/// compiler, so that no list has to be written.
/// \tparam Enum   An enum class with enumerators from 0 on, at most 16.
/// \tparam Value  Enum, or std::optional<Enum>.
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

/// The command line of one program. The program adds its own options and then calls
/// parse().
///
/// The program adds each option in one call, with its name, the variable that holds its
/// value, one line of help, and the allowed values. --help shows these, and values()
/// returns the final values.
class CommandLine {
public:
    /// \param arguments  The name of the program and all arguments.
    explicit CommandLine(std::vector<std::string> arguments);
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;
    ~CommandLine();

    /// Sets the sentence at the top of --help.
    void about(const std::string& text);

    /// Begins a group of --help. It holds the options that are added after this call.
    /// \param heading  The heading of the group, such as "Photons".
    /// \param shared   Shared options that are listed in this group as well, such as
    ///                 "--seed".
    void group(const std::string& heading, const std::vector<std::string>& shared = {});

    /// Adds an option whose value is a number; for an integer type, a whole number
    /// below 2^53. The variable `value` must live as long as the command line. A
    /// default outside the range means that there is no default.
    /// \param name     The name of the option, such as "--radius".
    /// \param value    Holds the default, and after parse() the value of the user.
    /// \param help     The line of --help.
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
    /// Adds an option that chooses one of several values by a word. A value without a
    /// word can be the default, but cannot be chosen.
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
    /// Adds an option that chooses an enumerator of an enum.
    template <AnEnum Enum>
    void add(const std::string& name, Enum& value, const std::string& help) {
        add(name, value, help, words_of<Enum>());
    }
    /// Adds an option that chooses an enumerator of an enum. Without the option there
    /// is no value.
    template <typename Enum>
    void add(const std::string& name, std::optional<Enum>& value,
             const std::string& help) {
        add(name, value, help, words_of<Enum, std::optional<Enum>>());
    }
    /// Adds an option whose value is a word from a list, or any text if the list is
    /// empty. The name may then say what the text is, as in "--checkpoint FILE".
    void add(const std::string& name, std::string& value, const std::string& help,
             const std::vector<std::string>& words = {});
    /// Adds an option that takes all words up to the next option as its values.
    void add(const std::string& name, std::vector<std::string>& values,
             const std::string& help);
    /// Adds a switch, which is true if it is given.
    void add(const std::string& name, bool& value, const std::string& help);

    /// Adds a switch that prints a text and ends the program, whatever else is given.
    void prints(const std::string& name, const std::string& help,
                std::function<std::string()> text);

    /// Adds the option --only, which chooses one of the items that the program makes,
    /// such as "fig-5".
    void makes(const std::vector<std::string>& items);

    /// Adds a positional argument, which must be given.
    /// \param name   The name of the argument in --help.
    /// \param value  Receives the argument.
    /// \param help   The line of --help.
    void add_positional(const std::string& name, std::string& value,
                        const std::string& help);
    /// Lets --out name a file of one of these types, or a folder for such a file.
    /// parse() then neither creates nor checks the folder; require_writable() does.
    /// \param types  Extensions, such as ".png".
    void file_types(const std::vector<std::string>& types);

    /// Removes options that have no meaning for this program.
    /// \param names  Names of shared options, such as "--seed".
    void without(const std::vector<std::string>& names);

    /// Whether the user gave this option.
    [[nodiscard]] bool given(const std::string& name) const;

    /// The names of all options that were given, such as "--seed".
    [[nodiscard]] std::vector<std::string> all_given() const;

    /// The heading of the group to which an option belongs; empty if there is none.
    [[nodiscard]] std::string group_of(const std::string& name) const;

    /// The current value of each setting of a group, as its name, such as "seed", and
    /// its value in JSON. Free texts, such as names of files, are left out, and so are
    /// settings without a value.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>>
    values(const std::string& heading) const;

    /// Reads the command line, creates the folder for the files, and tests whether
    /// files can be written there, before the program begins its work.
    /// \param presets  The frame of each quality.
    /// \throws Exit  for --help and --version, which have printed their text.
    /// \throws std::invalid_argument  for a wrong command line.
    /// \throws std::runtime_error     for a folder that cannot be used.
    [[nodiscard]] Options parse(const Presets& presets = {});

    /// Sets size and rays that the user did not give.
    /// \param frame  Size and rays.
    /// \return All options.
    Options fill(const Frame& frame);

    /// Sets the values of the user again, after a preset has overwritten them.
    void give_again();

private:
    struct Parser;
    // These do the work of the templates. `read` returns the value, and `take` sets it.
    void add_number(const std::string& name, const std::string& help, bool whole,
                    double least, double most, bool or_zero,
                    std::function<std::string()> read,
                    std::function<void(double)> take);
    // Words are given by index; an index past the last word means no word.
    void add_words(const std::string& name, const std::string& help,
                   const std::vector<std::string>& words,
                   std::function<std::size_t()> read,
                   std::function<void(std::size_t)> take);
    std::unique_ptr<Parser> parser_;
};

/// Checks that a file can be written, before the program begins its work. Creates its
/// folder if that is missing.
/// \param path  The file; an existing one is not changed.
/// \throws std::runtime_error  with the path and the reason.
void require_writable(const std::string& path);

/// The two numbers of "120,80" or "3/16".
/// \param text     The text of the user.
/// \param between  The character between the numbers.
/// \return Two whole numbers; nothing if the text has another form.
[[nodiscard]] std::optional<std::pair<int, int>> two_numbers(const std::string& text,
                                                             char between);

/// Thrown to end a program with this code, which run_main() returns.
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
/// \return 0 after success; 2 after an exception, with one sentence on stderr; 130 (128
///         plus the signal) after Ctrl-C.
int run_main(int argc, const char* const* argv,
             const std::function<void(CommandLine&)>& body);

} // namespace examples

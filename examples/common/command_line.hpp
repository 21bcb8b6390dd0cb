#pragma once

/// \file examples/common/command_line.hpp
/// \brief The command line that all example programs share.
///
/// The work is done by CLI11 in command_line.cpp, which is compiled once: its header
/// takes longer to compile than a whole chapter.

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

/// How much time a picture may take.
enum class Quality {
    draft,    ///< A second or so: does it work?
    report,   ///< As the report has it.
    reference ///< As good as it gets.
};

/// The size of a picture and the rays per pixel.
struct Frame {
    int width = 400;  ///< In pixels; 0: a file says it, and fill() takes it.
    int height = 400; ///< In pixels; 0 as well.
    int samples = 64; ///< Rays per pixel.
};

/// What each quality stands for in a program; what is given by name comes before it.
struct Presets {
    Frame draft{.width = 100, .height = 100, .samples = 4};   ///< --quality draft
    Frame report{.width = 400, .height = 400, .samples = 64}; ///< --quality report
    Frame reference{
        .width = 400, .height = 400, .samples = 1024}; ///< --quality reference
};

/// What the user asked for.
struct Options {
    std::string out = ".";             ///< --out: the folder of all files; it exists.
    std::string file;                  ///< The file's name, if --out named a file.
    Quality quality = Quality::report; ///< --quality
    std::uint64_t seed = 1;            ///< --seed
    int threads = 0;                   ///< --threads: 0 for all processors.
    int width = 0;                     ///< --width, in pixels.
    int height = 0;                    ///< --height, in pixels.
    int samples = 0;                   ///< --rays, per pixel.
    bool quiet = false;                ///< --quiet: no progress bar, no text.
    std::string only; ///< --only, of a program that makes several items.

    /// Whether an item is to be made: --only names it, or is not given.
    [[nodiscard]] bool wants(const std::string& item) const {
        return only.empty() || only == item;
    }

    /// The path of a file in the folder.
    /// \param name  Name of the file, as "ch04_sphere.png".
    /// \throws Interrupted  after Ctrl-C, so that no half-made picture is saved.
    [[nodiscard]] std::string path(const std::string& name) const;

    /// One of three values, that of the quality.
    template <typename Value>
    [[nodiscard]] Value pick(Value draft, Value report, Value reference) const {
        if (quality == Quality::draft) return draft;
        return quality == Quality::report ? report : reference;
    }
};

/// Words, and the value that each stands for.
template <typename Value>
using Words = std::vector<std::pair<std::string, Value>>;

namespace detail {

// A sentence of the compiler with the enumerator's name in it, or a number if there is
// none.
template <auto value>
[[nodiscard]] const char* spelled() {
#ifdef _MSC_VER
    return __FUNCSIG__;
#else
    return __PRETTY_FUNCTION__;
#endif
}

// "multi-jittered" of "... value = ljus::Sampling::multi_jittered]"; nothing of a
// number.
[[nodiscard]] std::string word_in(const std::string& spelled);

} // namespace detail

/// The words of an enum: its enumerators, with a - for each _. A list by hand would
/// have to be kept in step.
/// \tparam Enum   An enum class with enumerators from 0 on, at most 16.
/// \tparam Value  It, or a std::optional of it.
template <typename Enum, typename Value = Enum>
[[nodiscard]] Words<Value> words_of() {
    Words<Value> words;
    [&words]<int... i>(std::integer_sequence<int, i...>) {
        (words.emplace_back(detail::word_in(detail::spelled<static_cast<Enum>(i)>()),
                            static_cast<Enum>(i)),
         ...);
    }
    (std::make_integer_sequence<int, 16>{});
    std::erase_if(words, [](const auto& word) { return word.first.empty(); });
    return words;
}

/// A number, and no switch.
template <typename T>
concept ANumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// An enum.
template <typename T>
concept AnEnum = std::is_enum_v<T>;

/// What has to be told from a text.
template <typename T>
concept NoText = !std::is_same_v<T, std::string>;

/// The command line of one program: first its own options, then parse().
///
/// An option is a setting that stands in one line of the program: its name, the member
/// that holds its value, one line of help, and the values it takes. --help shows all
/// that, and values() tells what each setting is in the end.
class CommandLine {
public:
    /// \param arguments  The program's name and what follows it.
    explicit CommandLine(std::vector<std::string> arguments);
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;
    ~CommandLine();

    /// One sentence at the top of --help.
    void about(const std::string& text);

    /// Begins a group of --help: options that are added from here on stand in it.
    /// \param heading  As "Photons".
    /// \param shared   Options of all programs that stand in it, too, as "--seed".
    void group(const std::string& heading, const std::vector<std::string>& shared = {});

    /// An option of the program with a number, or a whole number below 2^53; `value`
    /// holds the default, and must live as long as the command line. A default that is
    /// not allowed stands for none.
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
    /// One of several values, each of which has a word; a value without a word may be
    /// the default, but cannot be asked for.
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
    /// The same, or none of them unless one is asked for.
    template <typename Enum>
    void add(const std::string& name, std::optional<Enum>& value,
             const std::string& help) {
        add(name, value, help, words_of<Enum, std::optional<Enum>>());
    }
    /// A word out of a list; any text if the list is empty, and then the name may say
    /// what kind of text, as "--checkpoint FILE".
    void add(const std::string& name, std::string& value, const std::string& help,
             const std::vector<std::string>& words = {});
    /// One or more words: all that follow up to the next option.
    void add(const std::string& name, std::vector<std::string>& values,
             const std::string& help);
    /// A switch: false unless it is given.
    void add(const std::string& name, bool& value, const std::string& help);

    /// The report's items that the program makes, as "fig-5": --only takes one of them.
    void makes(const std::vector<std::string>& items);

    /// An argument without a name in front, which must be given.
    /// \param name   What --help calls it.
    /// \param value  Takes what the user gave.
    /// \param help   One line.
    void add_positional(const std::string& name, std::string& value,
                        const std::string& help);
    /// Lets --out name a file of one of these types, or a folder for one; neither is
    /// made or tried by parse(): see require_writable().
    /// \param types  As ".png".
    void file_types(const std::vector<std::string>& types);

    /// Takes options away that mean nothing to this program.
    /// \param names  Of those that all programs share, as "--seed".
    void without(const std::vector<std::string>& names);

    /// Whether an option was given by name, and does not come from a quality or
    /// default.
    [[nodiscard]] bool given(const std::string& name) const;

    /// The names of all options that were given, as "--seed".
    [[nodiscard]] std::vector<std::string> all_given() const;

    /// The heading of the group that an option stands in; empty if there is none such.
    [[nodiscard]] std::string group_of(const std::string& name) const;

    /// All settings of a group as they are now, whoever has set them: their names, as
    /// "seed", and their values as JSON. Texts that are no words, such as names of
    /// files, are left out, and so is a word that nobody has chosen.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>>
    values(const std::string& heading) const;

    /// Reads the command line, and makes the folder for the files and tries it, before
    /// any work is done in vain.
    /// \param presets  What the qualities stand for.
    /// \throws Exit  for --help and --version, which have printed their text.
    /// \throws std::invalid_argument  for a wrong command line.
    /// \throws std::runtime_error     for a folder that cannot be used.
    [[nodiscard]] Options parse(const Presets& presets = {});

    /// Takes the size and the rays that were not given from a file, or from what was
    /// chosen after parse().
    /// \param frame  Size and rays.
    /// \return All options.
    Options fill(const Frame& frame);

    /// Writes once more what the user gave: after a preset that has set everything.
    void give_again();

private:
    struct Parser;
    // What the templates come to: `read` tells the value, and `take` sets it.
    void add_number(const std::string& name, const std::string& help, bool whole,
                    double least, double most, bool or_zero,
                    std::function<std::string()> read,
                    std::function<void(double)> take);
    // Words have numbers; beyond the last one for none of them.
    void add_words(const std::string& name, const std::string& help,
                   const std::vector<std::string>& words,
                   std::function<std::size_t()> read,
                   std::function<void(std::size_t)> take);
    std::unique_ptr<Parser> parser_;
};

/// Makes sure that a file can be written, before any work is done in vain; makes its
/// folder if it is missing.
/// \param path  The file; an older one is left as it is.
/// \throws std::runtime_error  with the path and the reason.
void require_writable(const std::string& path);

/// The two numbers of "120,80" or "3/16".
/// \param text     What the user gave.
/// \param between  The character between them.
/// \return Two whole numbers, or nothing if the text is anything else.
[[nodiscard]] std::optional<std::pair<int, int>> two_numbers(const std::string& text,
                                                             char between);

/// Ends a program with this code; run_main() returns it.
struct Exit {
    int code = 0; ///< 0 for success, 2 for a wrong use.
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
/// \return 0; 2 with one sentence on stderr for anything that is thrown; 130 after
///         Ctrl-C (128 plus the signal).
int run_main(int argc, const char* const* argv,
             const std::function<void(CommandLine&)>& body);

} // namespace examples

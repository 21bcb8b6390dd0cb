/// \file command_line.cpp
/// \brief The command line that the example programs share.

// The one file that includes CLI11.
#include "command_line.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <new>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <thread>

#include <CLI/CLI.hpp>

#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#endif

#include "ljus/io/file.hpp"
#include "ljus/io/nearest_word.hpp"
#include "ljus/parallel.hpp"

namespace examples {

namespace {

std::string version_text() {
    return "Ljus " + std::to_string(LJUS_VERSION_MAJOR) + "." +
           std::to_string(LJUS_VERSION_MINOR) + "." +
           std::to_string(LJUS_VERSION_PATCH);
}

// Creates the folder if it is missing, and tests it by writing and removing a file.
void require_folder(const std::string& folder) {
    const auto fail = [&](const std::string& why) {
        throw std::runtime_error("cannot write into the folder '" +
                                 ljus::shown_path(folder) + "' of --out: " + why);
    };
    if (folder.empty()) fail("its name is empty");
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) fail(error.message());
    if (!std::filesystem::is_directory(folder, error)) fail("it is no folder");
    // Permissions alone do not decide whether a file can be written, so one is written.
    ljus::require_writable((std::filesystem::path(folder) / "probe").string());
}

// Returns "; did you mean --preset?", or nothing if no option is similar.
std::string proposal_of_option(const CLI::App& app, const std::string& word) {
    std::vector<std::string> names;
    for (const CLI::Option* const option : app.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    const std::string near =
        word.starts_with("--") ? ljus::nearest_word(word, names) : "";
    return near.empty() ? "" : "; did you mean " + near + "?";
}

// The words as a list: ".png, .hdr or .pfm".
std::string list_of(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " or ") + words[i];
    return text;
}

// The end of a message about a wrong word: it proposes the nearest word and lists all.
std::string right_word(const std::string& wrong,
                       const std::vector<std::string>& words) {
    const std::string near = ljus::nearest_word(wrong, words);
    return (near.empty() ? "it" : "did you mean " + near + "? It") + " must be " +
           list_of(words);
}

// A message as one line without its full stop, fit for printing. It may quote what a
// user typed, which can have any length and any bytes.
std::string without_end(std::string text, std::size_t limit) {
    const std::size_t end = text.find_last_not_of(" \n.");
    text.erase(end == std::string::npos ? 0 : end + 1);
    for (char& c : text)
        if (c == '\n') c = ' ';
    return ljus::shown(std::move(text), limit);
}

// Whether the name is that of a picture, not of a folder.
bool names_a_file(std::string out) {
    for (char& c : out) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    const std::string kind = std::filesystem::path(out).extension().string();
    constexpr const char* kinds[] = {".png", ".jpg", ".jpeg", ".exr",  ".ppm", ".pgm",
                                     ".hdr", ".pfm", ".bmp",  ".tga",  ".gif", ".tif",
                                     ".svg", ".pdf", ".webp", ".tiff", ".json"};
    return std::find(std::begin(kinds), std::end(kinds), kind) != std::end(kinds);
}

// Starts as many threads as OpenMP will need. Otherwise OpenMP would end the program if
// it cannot start its threads.
void require_threads(int wanted) {
    const int count = wanted == 0 ? ljus::max_threads() : wanted;
    std::vector<std::thread> threads;
    std::string why;
    std::mutex wait;
    {
        const std::lock_guard all_at_a_time(wait);
        try {
            for (int i = 1; i < count; ++i)
                threads.emplace_back([&wait] { const std::lock_guard turn(wait); });
        } catch (const std::system_error& error) {
            why = error.code().message();
        }
    }
    for (std::thread& thread : threads) thread.join();
    if (!why.empty())
        throw std::runtime_error("cannot start " + std::to_string(count) +
                                 " threads: " + why + "; --threads 1 needs none");
    // Now OpenMP starts its threads, and keeps them, before the work needs the memory.
    ljus::parallel_blocks(count, [](long long) {}, {.threads = wanted});
}

// Refuses limits of the stack with which the program would end without a clear message.
void require_stacks() {
    constexpr double least = 256 << 10, most = 1 << 30;
    if (const char* const given = std::getenv("OMP_STACKSIZE")) {
        double size = 0;
        char unit = 'K';
        const bool is_size = std::sscanf(given, "%lf %c", &size, &unit) > 0;
        const std::string_view units = "BbKkMmGg";
        size *= std::pow(1024.0, units.find(unit) / 2);
        if (is_size && (size < least || size > most))
            throw std::runtime_error("the environment variable OMP_STACKSIZE is '" +
                                     ljus::shown(given) +
                                     "'; it must be from 256K to 1G");
    }
#if __has_include(<sys/resource.h>)
    ::rlimit stack{};
    if (::getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur < ::rlim_t(least))
        throw std::runtime_error("the limit of the stack (ulimit -s) is " +
                                 std::to_string(stack.rlim_cur >> 10) +
                                 " kilobytes; it must be at least 256");
#endif
}

// Whether a text is a number in the form that all options take: an optional minus sign,
// digits without leading zeros and, unless the number must be whole, an optional
// fraction and exponent. The conversions of the libraries also accept 010 for 8, 0x10,
// blanks and nan.
bool is_number(std::string_view text, bool whole) {
    const auto digits = [&text] {
        const std::size_t count =
            std::min(text.find_first_not_of("0123456789"), text.size());
        text.remove_prefix(count);
        return count;
    };
    const auto skip = [&text](std::string_view any) {
        const bool there = !text.empty() && any.find(text[0]) != any.npos;
        if (there) text.remove_prefix(1);
        return there;
    };
    skip("-");
    const bool zero = text.starts_with('0');
    std::size_t count = digits();
    if (zero && count > 1) return false;
    if (whole) return count > 0 && text.empty();
    if (skip(".")) count += digits();
    if (count == 0) return false;
    if (skip("eE")) {
        skip("+-");
        if (digits() == 0) return false;
    }
    return text.empty();
}

// The whole number in a text; nothing if the text has another form or is out of range.
template <typename Whole>
std::optional<Whole> whole_number(std::string_view text) {
    Whole number = 0;
    const auto [rest, error] =
        std::from_chars(text.data(), text.data() + text.size(), number);
    if (!is_number(text, true) || error != std::errc() ||
        rest != text.data() + text.size())
        return std::nullopt;
    return number;
}

// Reads a seed. The conversion of CLI11 would read -1 as the largest seed.
std::string take_seed(const std::string& text, std::uint64_t& seed) {
    const auto given = whole_number<std::uint64_t>(text);
    if (!given) return "it must be a whole number from 0 to 18446744073709551615";
    seed = *given;
    return "";
}

} // namespace

std::string word_in(const std::string& spelled) {
    // "(ljus::Sampling)9" is no enumerator. Some compilers write "...<...>(void)".
    const std::size_t end = spelled.find_last_of(spelled.back() == ']' ? ']' : '>');
    const std::size_t begin = spelled.rfind(':', end) + 1;
    std::string word = spelled.substr(begin, end - begin);
    if (word.find_first_of(")(") != std::string::npos) return "";
    std::replace(word.begin(), word.end(), '_', '-');
    return word;
}

void require_writable(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    require_folder(folder.empty() ? "." : folder.string());
    ljus::require_writable(path);
}

std::optional<std::pair<int, int>> two_numbers(const std::string& text, char between) {
    const std::string_view all = text;
    const std::size_t at = all.find(between);
    if (at == all.npos) return std::nullopt;
    const auto first = whole_number<int>(all.substr(0, at));
    const auto second = whole_number<int>(all.substr(at + 1));
    if (!first || !second) return std::nullopt;
    return std::pair{*first, *second};
}

std::string Options::path(const std::string& name) const {
    stop_if_asked();
    return (std::filesystem::path(out) / name).string();
}

struct CommandLine::Parser {
    CLI::App app;
    std::vector<std::string> arguments;
    std::vector<std::string> file_types;
    std::string out = "."; // a folder, or a file
    Options options;
    // The current value of each option, as JSON.
    std::vector<std::pair<CLI::Option*, std::function<std::string()>>> settings;

    // Adds an option. `read` returns its value as JSON. `take` sets the value, or
    // returns which values are allowed.
    void add_setting(const std::string& name, const std::string& kind,
                     const std::string& help, std::function<std::string()> read,
                     std::function<std::string(const std::string&)> take) {
        std::string value = read();
        std::erase(value, '"');
        if (kind == "X" && value.size() > 8) value.resize(5); // 0.666
        CLI::Option* const option = app.add_option_function<std::string>(
            name,
            [take, first = name.substr(0, name.find(','))](const std::string& text) {
                const std::string right = take(text);
                if (!right.empty())
                    throw std::invalid_argument(first + " is '" +
                                                ljus::shown(text, 200) + "'; " + right +
                                                " (see --help)");
            },
            value.empty() ? help : help + " [" + value + "]");
        option->option_text(kind);
        settings.emplace_back(option, std::move(read));
    }
};

CommandLine::CommandLine(std::vector<std::string> arguments)
    : parser_(std::make_unique<Parser>()) {
    CLI::App& app = parser_->app;
    Options& options = parser_->options;
    parser_->arguments = std::move(arguments);
    const std::string program =
        parser_->arguments.empty() ? "example" : parser_->arguments.front();
    app.name(std::filesystem::path(program).filename().string());
    app.set_help_flag("-h,--help", "Print this text");
    app.set_version_flag("--version", version_text(), "Print the version");
    app.get_formatter()->column_width(32);
    app.get_formatter()->label("Positionals", "Arguments");

    // If an option is given twice, the last one counts, so that one can append to the
    // options of a script.
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.add_option("--out", parser_->out,
                   "Folder for the files, made if it is missing [.]")
        ->option_text("DIR");
    add("--quality", options.quality, "Size of the pictures and rays per pixel");
    parser_->add_setting(
        "--seed", "N", "Another seed, other noise",
        [&options] { return std::to_string(options.seed); },
        [&options](const std::string& text) { return take_seed(text, options.seed); });
    add("--threads", options.threads, "0 for all processors", 0,
        ljus::max_threads_allowed);
    add("--width", options.width, "Width of the picture in pixels", 1, 65536);
    add("--height", options.height, "Height of the picture in pixels", 1, 65536);
    add("--rays,--spp", options.samples, "Rays per pixel", 1, 100'000'000);
    add("--quiet", options.quiet, "No progress bar, no text but remarks (on stderr)");
}

CommandLine::~CommandLine() = default;

void CommandLine::about(const std::string& text) {
    parser_->app.description(text);
}

void CommandLine::group(const std::string& heading,
                        const std::vector<std::string>& shared) {
    parser_->app.option_defaults()->group(heading);
    for (const std::string& name : shared)
        parser_->app.get_option(name)->group(heading);
}

void CommandLine::add_number(const std::string& name, const std::string& help,
                             bool whole, double least, double most, bool or_zero,
                             std::function<std::string()> read,
                             std::function<void(double)> take) {
    char range[100];
    std::snprintf(range, sizeof range,
                  whole ? "%sa whole number from %.0f to %.0f"
                        : "%sa number from %g to %g",
                  or_zero ? "0 or " : "", least, most);
    const auto good = [=](const std::string& text, double& number) { // not for NaN
        return is_number(text, whole) && CLI::detail::lexical_cast(text, number) &&
               ((number >= least && number <= most) || (or_zero && number == 0));
    };
    parser_->add_setting(
        name, whole ? "N" : "X", help,
        [good, read] {
            double number = 0;
            return good(read(), number) ? read() : "";
        },
        [good, take, right = std::string(range)](const std::string& text) {
            double number = 0;
            if (!good(text, number)) return "it must be " + right;
            take(number);
            return std::string();
        });
}

void CommandLine::add_words(const std::string& name, const std::string& help,
                            const std::vector<std::string>& words,
                            std::function<std::size_t()> read,
                            std::function<void(std::size_t)> take) {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : "|") + word;
    parser_->add_setting(
        name, all, help,
        [words, read] {
            const std::size_t i = read();
            return i < words.size() ? "\"" + words[i] + "\"" : std::string();
        },
        [words, take](const std::string& text) {
            const auto found = std::find(words.begin(), words.end(), text);
            if (found == words.end()) return right_word(text, words);
            take(std::size_t(found - words.begin()));
            return std::string();
        });
}

void CommandLine::add(const std::string& name, std::string& value,
                      const std::string& help, const std::vector<std::string>& words) {
    if (!words.empty()) {
        const auto read = [&value, words] {
            return std::size_t(std::find(words.begin(), words.end(), value) -
                               words.begin());
        };
        return add_words(name, help, words, read,
                         [&value, words](std::size_t i) { value = words[i]; });
    }
    const std::size_t space = std::min(name.find(' '), name.size());
    parser_->app
        .add_option(name.substr(0, space), value,
                    value.empty() ? help : help + " [" + value + "]")
        ->option_text(space < name.size() ? name.substr(space + 1) : "TEXT");
}

void CommandLine::add(const std::string& name, std::vector<std::string>& values,
                      const std::string& help) {
    parser_->app.add_option(name, values, help)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->option_text("FILE...");
}

void CommandLine::add(const std::string& name, bool& value, const std::string& help) {
    CLI::Option* const option = parser_->app.add_flag(name, value, help);
    parser_->settings.emplace_back(option,
                                   [&value] { return value ? "true" : "false"; });
}

void CommandLine::prints(const std::string& name, const std::string& help,
                         std::function<std::string()> text) {
    parser_->app.add_flag_callback(
        name, [text = std::move(text)] { throw CLI::CallForVersion(text(), 0); }, help);
}

void CommandLine::makes(const std::vector<std::string>& items) {
    parser_->app.add_option("--only", parser_->options.only, "Make only this item")
        ->check(CLI::IsMember(items).description(""))
        ->option_text("WORD");
}

void CommandLine::add_positional(const std::string& name, std::string& value,
                                 const std::string& help) {
    parser_->app.add_option(name, value, help)
        ->required()
        ->option_text("(must be given)");
}

void CommandLine::file_types(const std::vector<std::string>& types) {
    parser_->file_types = types;
    parser_->app.get_option("--out")
        ->description("The file, or a folder for it [.]")
        ->option_text("PATH");
}

void CommandLine::without(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        CLI::Option* const option = parser_->app.get_option(name);
        std::erase_if(parser_->settings, [option](const auto& setting) {
            return setting.first == option;
        });
        parser_->app.remove_option(option);
    }
}

bool CommandLine::given(const std::string& name) const {
    const CLI::Option* const option = parser_->app.get_option_no_throw(name);
    return option != nullptr && option->count() > 0;
}

std::vector<std::string> CommandLine::all_given() const {
    std::vector<std::string> names;
    for (const CLI::Option* const option : parser_->app.get_options())
        if (option->count() > 0 && !option->get_positional())
            names.push_back(option->get_name());
    return names;
}

std::string CommandLine::group_of(const std::string& name) const {
    const CLI::Option* const option = parser_->app.get_option_no_throw(name);
    return option != nullptr ? option->get_group() : "";
}

std::vector<std::pair<std::string, std::string>>
CommandLine::values(const std::string& heading) const {
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& [option, read] : parser_->settings)
        if (std::string value = read();
            option->get_group() == heading && !value.empty())
            all.emplace_back(option->get_lnames().front(), std::move(value));
    return all;
}

Options CommandLine::fill(const Frame& frame) {
    Options& options = parser_->options;
    if (!given("--width")) options.width = frame.width;
    if (!given("--height")) options.height = frame.height;
    if (!given("--rays")) options.samples = frame.samples;
    return options;
}

void CommandLine::give_again() {
    for (const CLI::Option* const option : parser_->app.get_options())
        if (option->count() > 0)
            parser_->app.get_option(option->get_name())->run_callback();
}

Options CommandLine::parse(const Presets& presets) {
    CLI::App& app = parser_->app;
    Options& options = parser_->options;
    const Frame& usual = presets.report;
    for (const auto& [name, number] : {std::pair{"--width", usual.width},
                                       {"--height", usual.height},
                                       {"--rays", usual.samples}})
        if (CLI::Option* const option = app.get_option_no_throw(name))
            option->description(option->get_description() + " [" +
                                (number > 0 ? std::to_string(number) : "by the scene") +
                                "]");
    std::vector<const char*> words;
    for (const std::string& word : parser_->arguments) words.push_back(word.c_str());
    try {
        app.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::ParseError& error) {
        // --help and --version also arrive here; they are not errors.
        if (error.get_exit_code() == 0) {
            std::ostringstream text;
            (void)app.exit(error, text);
            std::fputs(
                CLI::detail::find_and_replace(text.str(), "\n\n\n", "\n\n").c_str(),
                stdout);
            throw Exit{0};
        }
        if (const auto rest = app.remaining(); !rest.empty())
            throw std::invalid_argument(
                "there is no option or argument '" + without_end(rest.front(), 800) +
                "'" + proposal_of_option(app, rest.front()) + " (see --help)");
        std::string said = error.what();
        if (error.get_name() == "ArgumentMismatch")
            said = said.substr(0, said.find(':')) + " needs a value";
        throw std::invalid_argument(without_end(said, 800) + " (see --help)");
    }
    fill(options.pick(presets.draft, presets.report, presets.reference));
    const std::vector<std::string>& types = parser_->file_types;
    if (given("--out") && parser_->out.empty())
        throw std::invalid_argument("--out is empty; it must be a name");
    const std::filesystem::path out = options.out = parser_->out;
    std::error_code error; // the text need not be a valid name
    const bool folder = std::filesystem::is_directory(out, error);
    if (std::find(types.begin(), types.end(), out.extension()) != types.end() &&
        !folder) {
        options.file = out.filename().string();
        options.out = out.has_parent_path() ? out.parent_path().string() : ".";
    }
    if (options.file.empty() && names_a_file(options.out) && !folder)
        throw std::invalid_argument(
            types.empty()
                ? "--out is " + options.out + "; it must be a folder, for all files"
                : "--out is " + options.out + "; the name of a file must end in " +
                      list_of(types) + ", and any other is that of a folder");
    require_stacks();
    require_threads(options.threads);
    if (types.empty()) require_folder(options.out);
    return options;
}

int run_main(int argc, const char* const* argv,
             const std::function<void(CommandLine&)>& body) {
    const struct LetBe {
        ~LetBe() { let_be(); }
    } at_the_end;
    std::string name = argc > 0 ? argv[0] : "example";
    const auto complain = [&name](const std::string& what) {
        std::fprintf(stderr, "%s: %s.\n", name.c_str(),
                     without_end(what, 1500).c_str());
        return 2;
    };
    // Text that could not be written, to a full disk or a closed pipe, is reported as
    // an error. A closed pipe gets no message. The reason is known only if the last
    // write failed.
    const auto lost_text = [&complain] {
        const int error = std::fflush(stdout) != 0 ? errno : 0;
        if (error == 0 && std::ferror(stdout) == 0 && std::ferror(stderr) == 0)
            return 0;
        if (broken_pipe != 0) return 128 + broken_pipe;
        return complain(
            "cannot write to standard output" +
            (error != 0 ? ": " + std::generic_category().message(error) : ""));
    };
    const auto stopped = [&name] {
        std::fprintf(stderr, "%s: stopped%s.\n", name.c_str(), last_words_text());
        return 128 + stop_signal();
    };
    try {
        name = std::filesystem::path(name).filename().string();
        handle_signals();
        CommandLine line({argv, argv + argc});
        body(line);
        if (const int code = lost_text()) return code;
        stop_if_asked();
        return 0;
    } catch (const Exit& exit) {
        return exit.code != 0 ? exit.code : lost_text();
    } catch (const Interrupted&) {
        return stopped();
    } catch (const std::bad_alloc&) {
        return complain("there is not enough memory");
    } catch (const std::exception& error) {
        // After Ctrl-C an error is probably a consequence of it.
        if (stop_signal() != 0) return stopped();
        return complain(error.what());
    } catch (...) {
        return complain("an exception of an unknown type was thrown");
    }
}

} // namespace examples

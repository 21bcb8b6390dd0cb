/// \file command_line.cpp
/// \brief The command line that the example programs share.

// The one file that includes CLI11.
#include "command_line.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>

#include <CLI/CLI.hpp>

#include "ljus/io/file.hpp"
#include "ljus/parallel.hpp"

namespace examples {

namespace {

std::string version_text() {
    return "Ljus " + std::to_string(LJUS_VERSION_MAJOR) + "." +
           std::to_string(LJUS_VERSION_MINOR) + "." +
           std::to_string(LJUS_VERSION_PATCH);
}

// Makes the folder if it is missing, and writes and removes a file in it.
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
    // Whether that works depends on more than the permissions: it is tried.
    ljus::require_writable((std::filesystem::path(folder) / "probe").string());
}

// ".png, .hdr or .pfm".
std::string list_of(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " or ") + words[i];
    return text;
}

// One line without its full stop. It may repeat a word that a user typed, which is as
// long as it likes and of any bytes.
std::string without_end(std::string text, std::size_t limit) {
    const std::size_t end = text.find_last_not_of(" \n.");
    text.erase(end == std::string::npos ? 0 : end + 1);
    for (char& c : text)
        if (c == '\n') c = ' ';
    return ljus::shown(std::move(text), limit);
}

// A name that only a picture has, and no folder.
bool names_a_file(std::string out) {
    for (char& c : out) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    const std::string kind = std::filesystem::path(out).extension().string();
    constexpr const char* kinds[] = {".png", ".jpg", ".jpeg", ".exr",  ".ppm", ".pgm",
                                     ".hdr", ".pfm", ".bmp",  ".tga",  ".gif", ".tif",
                                     ".svg", ".pdf", ".webp", ".tiff", ".json"};
    return std::find(std::begin(kinds), std::end(kinds), kind) != std::end(kinds);
}

// A library that makes threads ends the program when there are none to be had: so they
// are asked for first.
void require_threads(int wanted) {
    const int count = wanted == 0 ? ljus::detail::max_threads() : wanted;
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
}

// Digits, and a sign: the parser's own conversion takes 010 for 8.
std::string check_whole(const std::string& text, long long least, long long most) {
    long long value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    const std::size_t first = text.find_first_not_of('-');
    const bool octal = first + 1 < text.size() && text[first] == '0';
    if (rest != end || text.empty() || octal || error == std::errc::invalid_argument)
        return "Value " + text + " is no whole number";
    if (error == std::errc() && value >= least && value <= most) return "";
    return "Value " + text + " not in range " + std::to_string(least) + " to " +
           std::to_string(most);
}

auto whole(long long least, long long most) {
    return [least, most](const std::string& text) {
        return check_whole(text, least, most);
    };
}

// All digits, and below 2^64: the parser's own conversion takes -1 for the largest seed.
std::optional<std::uint64_t> to_seed(const std::string& text) {
    std::uint64_t seed = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, seed);
    if (error != std::errc() || rest != end) return std::nullopt;
    return seed;
}

std::string check_seed(const std::string& text) {
    if (to_seed(text)) return "";
    return "Value " + text + " not in range 0 to 18446744073709551615";
}

} // namespace

void require_writable(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    require_folder(folder.empty() ? "." : folder.string());
    ljus::require_writable(path);
}

std::string Options::path(const std::string& name) const {
    stop_if_asked();
    return (std::filesystem::path(out) / name).string();
}

struct CommandLine::Parser {
    CLI::App app;
    std::vector<std::string> arguments;
    std::vector<std::string> file_types;
    Options options;
    std::string quality = "report";
    std::string seed = "1";
};

CommandLine::CommandLine(std::vector<std::string> arguments)
    : parser_(std::make_unique<Parser>()) {
    CLI::App& app = parser_->app;
    Options& options = parser_->options;
    parser_->arguments = std::move(arguments);
    const std::string program =
        parser_->arguments.empty() ? "example" : parser_->arguments.front();
    app.name(std::filesystem::path(program).filename().string());
    app.set_version_flag("--version", version_text());
    app.get_formatter()->column_width(32);

    // Given twice, the last one counts: a script's options can be followed by one's own.
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.add_option("--out", options.out,
                   "Folder for the files, made if it is missing [.]")
        ->option_text("DIR");
    app.add_option("--quality", parser_->quality,
                   "draft, report or reference: size and rays [report]")
        ->check(CLI::IsMember({"draft", "report", "reference"}).description(""))
        ->option_text("WORD");
    app.add_option("--seed", parser_->seed, "Another seed, other noise [1]")
        ->check(check_seed)
        ->option_text("N");
    app.add_option("--threads", options.threads, "0 for all processors [0]")
        ->check(whole(0, ljus::max_threads_allowed))
        ->option_text("N");
    app.add_option("--width", options.width, "Width of the picture in pixels")
        ->check(whole(1, 65536))
        ->option_text("N");
    app.add_option("--height", options.height, "Height of the picture in pixels")
        ->check(whole(1, 65536))
        ->option_text("N");
    app.add_option("--rays,--spp", options.samples, "Rays per pixel")
        ->check(whole(1, 100'000'000))
        ->option_text("N");
    app.add_flag("--quiet", options.quiet, "No progress bar and no text");
}

CommandLine::~CommandLine() = default;

void CommandLine::about(const std::string& text) {
    parser_->app.description(text);
}

void CommandLine::add(const std::string& name, int& value, const std::string& help,
                      int least, int most) {
    parser_->app.add_option(name, value, help + " [" + std::to_string(value) + "]")
        ->check(whole(least, most))
        ->option_text("N");
}

void CommandLine::add(const std::string& name, long long& value,
                      const std::string& help, long long least, long long most) {
    parser_->app.add_option(name, value, help + " [" + std::to_string(value) + "]")
        ->check(whole(least, most))
        ->option_text("N");
}

void CommandLine::add(const std::string& name, double& value, const std::string& help,
                      double least, double most) {
    char text[32];
    const auto show = [&text](double number) {
        std::snprintf(text, sizeof text, "%g", number);
        return std::string(text);
    };
    const std::string range = show(least) + " to " + show(most);
    parser_->app.add_option(name, value, help + " [" + show(value) + "]")
        ->check([least, most, range](const std::string& given) {
            double number = 0.0;
            const bool ok = CLI::detail::lexical_cast(given, number) &&
                            number >= least && number <= most; // NaN is not
            return ok ? std::string() : "Value " + given + " not in range " + range;
        })
        ->option_text("X");
}

void CommandLine::add(const std::string& name, std::string& value,
                      const std::string& help, const std::vector<std::string>& words) {
    CLI::Option* const option =
        parser_->app.add_option(name, value, help + " [" + value + "]");
    option->option_text("WORD");
    if (!words.empty()) option->check(CLI::IsMember(words).description(""));
}

void CommandLine::add(const std::string& name, std::vector<std::string>& values,
                      const std::string& help) {
    parser_->app.add_option(name, values, help)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->option_text("FILE...");
}

void CommandLine::add(const std::string& name, bool& value, const std::string& help) {
    parser_->app.add_flag(name, value, help);
}

void CommandLine::makes(const std::vector<std::string>& items) {
    parser_->app.add_option("--only", parser_->options.only, "Make only this item")
        ->check(CLI::IsMember(items).description(""))
        ->option_text("WORD");
}

void CommandLine::add_positional(const std::string& name, std::string& value,
                                 const std::string& help) {
    parser_->app.add_option(name, value, help)->required();
}

void CommandLine::file_types(const std::vector<std::string>& types) {
    parser_->file_types = types;
    parser_->app.get_option("--out")
        ->description("The file, or a folder for it [.]")
        ->option_text("PATH");
}

void CommandLine::without(const std::vector<std::string>& names) {
    for (const std::string& name : names)
        parser_->app.remove_option(parser_->app.get_option(name));
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

Options CommandLine::parse(const Presets& presets) {
    CLI::App& app = parser_->app;
    Options& options = parser_->options;
    std::vector<const char*> words;
    for (const std::string& word : parser_->arguments) words.push_back(word.c_str());
    try {
        app.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::ParseError& error) {
        // --help and --version arrive here as well: those are no errors.
        if (error.get_exit_code() == 0) throw Exit{app.exit(error)};
        throw std::invalid_argument(without_end(error.what(), 800) + " (see --help)");
    }
    options.quality = parser_->quality == "draft"    ? Quality::draft
                      : parser_->quality == "report" ? Quality::report
                                                     : Quality::reference;
    options.seed = to_seed(parser_->seed).value();
    const Frame frame = options.pick(presets.draft, presets.report, presets.reference);
    if (!given("--width")) options.width = frame.width;
    if (!given("--height")) options.height = frame.height;
    if (!given("--rays")) options.samples = frame.samples;
    const std::vector<std::string>& types = parser_->file_types;
    const std::filesystem::path out = options.out;
    std::error_code error; // such a name may be no name at all, and then no folder
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
    require_threads(options.threads);
    if (types.empty()) require_folder(options.out);
    return options;
}

int run_main(int argc, const char* const* argv,
             const std::function<void(CommandLine&)>& body) {
    const struct LetBe {
        ~LetBe() { detail::let_be(); }
    } at_the_end;
    std::string name = argc > 0 ? argv[0] : "example";
    const auto complain = [&name](const std::string& what) {
        std::fprintf(stderr, "%s: %s.\n", name.c_str(),
                     without_end(what, 1500).c_str());
        return 2;
    };
    try {
        name = std::filesystem::path(name).filename().string();
        handle_signals();
        CommandLine line({argv, argv + argc});
        body(line);
        // What was said to a full disk or a closed pipe must not be lost in silence.
        if (std::fflush(stdout) != 0) {
            const int error = errno;
            return complain("cannot write to standard output: " +
                            std::generic_category().message(error));
        }
        stop_if_asked();
        return 0;
    } catch (const Exit& exit) {
        return exit.code;
    } catch (const Interrupted&) {
        return 128 + stop_signal();
    } catch (const std::bad_alloc&) {
        return complain("there is not enough memory");
    } catch (const std::exception& error) {
        // An error in the wake of Ctrl-C is no news.
        if (stop_signal() != 0) return 128 + stop_signal();
        return complain(error.what());
    } catch (...) {
        return complain("something unknown went wrong");
    }
}

} // namespace examples

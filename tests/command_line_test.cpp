// rest: the command line of the examples, no concept of the library
#include <doctest/doctest.h>

// The example programs need CLI11, the library does not.
#if __has_include(<CLI/CLI.hpp>)

#include <csignal>
#include <filesystem>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

#include "../examples/common/command_line.cpp"
#include "../examples/common/terminal.hpp"
#include "scratch_folder.hpp"
#include "support/little_memory.hpp"
#include "support/refusal.hpp"

#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace {

using examples::CommandLine;
using examples::Options;
using examples::Quality;

Options parse(std::vector<std::string> words, const examples::Presets& presets = {}) {
    words.insert(words.begin(), "program");
    CommandLine line(words);
    return line.parse(presets);
}

// What a wrong command line is answered with.
std::string answer(std::initializer_list<std::string> words) {
    return ljus_test::refusal<std::exception>([&] { (void)parse(words); }, "accepted");
}

template <typename Body>
int run(const Body& body, std::vector<const char*> words = {"program"}) {
    return examples::run_main(static_cast<int>(words.size()), words.data(), body);
}

} // namespace

TEST_CASE("command_line: what is not given comes from the quality") {
    const examples::Presets presets{
        .draft = {.width = 10, .height = 20, .samples = 1},
        .report = {.width = 30, .height = 40, .samples = 2},
        .reference = {.width = 50, .height = 60, .samples = 3}};
    const Options report = parse({}, presets);
    CHECK(report.quality == Quality::report);
    CHECK(report.width == 30);
    CHECK(report.height == 40);
    CHECK(report.samples == 2);
    CHECK(report.out == ".");
    CHECK(report.seed == 1);
    CHECK(report.threads == 0);
    CHECK_FALSE(report.quiet);
    const Options draft = parse({"--quality", "draft", "--height", "7"}, presets);
    CHECK(draft.width == 10);
    CHECK(draft.height == 7);
    CHECK(draft.samples == 1);
    CHECK(draft.pick(1, 2, 3) == 1);
    const Options reference = parse({"--quality=reference", "--spp=9"}, presets);
    CHECK(reference.width == 50);
    CHECK(reference.samples == 9);
    CHECK(reference.pick(1, 2, 3) == 3);
}

TEST_CASE("command_line: a text is printed even if a needed argument is missing") {
    examples::CommandLine line({"program", "--text"});
    std::string needed;
    bool asked = false;
    line.add_positional("SCENE", needed, "needed");
    line.prints("--text", "a text", [&asked] {
        asked = true;
        return std::string("text\n");
    });
    CHECK_THROWS_AS((void)line.parse(), examples::Exit);
    CHECK(asked);
}

TEST_CASE("command_line: every option arrives, and the last of two counts") {
    const ScratchFolder folder;
    const Options options = parse({"--out", folder.file("new/one"), "--seed",
                                   "18446744073709551615", "--threads", "3", "--width",
                                   "5", "--rays", "7", "--quiet", "--width", "6"});
    CHECK(options.seed == 18446744073709551615u);
    CHECK(options.threads == 3);
    CHECK(options.width == 6);
    CHECK(options.samples == 7);
    CHECK(options.quiet);
    CHECK(std::filesystem::is_directory(folder.path / "new" / "one"));
    CHECK(std::filesystem::is_empty(folder.path / "new" / "one"));
    CHECK(options.path("a.png") == (folder.path / "new" / "one" / "a.png").string());
}

TEST_CASE("command_line: a program's own options") {
    int count = 1;
    long long photons = 2;
    double radius = 0.5;
    std::string scene = "final";
    std::string text = "x";
    bool fast = false;
    CommandLine line({"program", "--count", "5", "--photons", "10000000000", "--radius",
                      "1e-3", "--scene", "cornell", "--fast"});
    line.about("A program.");
    line.add("--count", count, "How many", 1, 10);
    line.add("--photons", photons, "How many", 0, 1LL << 40);
    line.add("--radius", radius, "How large", 0.0, 1.0);
    line.add("--scene", scene, "Which", {"final", "cornell"});
    line.add("--text", text, "What");
    line.add("--fast", fast, "How");
    (void)line.parse();
    CHECK(count == 5);
    CHECK(photons == 10000000000);
    CHECK(radius == 1e-3);
    CHECK(scene == "cornell");
    CHECK(text == "x");
    CHECK(fast);
    CHECK(line.given("--count"));
    CHECK_FALSE(line.given("--text"));
}

TEST_CASE("command_line: what is wrong is named with its value") {
    CHECK(answer({"--width", "0"}) ==
          "--width is '0'; it must be a whole number from 1 to 65536 (see --help)");
    CHECK(answer({"--seed", "-1"}) ==
          "--seed is '-1'; it must be a whole number from 0 to 18446744073709551615 "
          "(see --help)");
    CHECK(answer({"--nope"}) == "there is no option or argument '--nope' (see --help)");
    CHECK(answer({"--widht", "3"}) == "there is no option or argument '--widht'; did "
                                      "you mean --width? (see --help)");
    CHECK(answer({"--quality", "drft"}) ==
          "--quality is 'drft'; did you mean draft? It must be draft, report or "
          "reference (see --help)");
    CHECK(answer({"--width"}) == "--width needs a value (see --help)");
    CHECK(answer({"--out", "a", "--quality"}) ==
          "--quality needs a value (see --help)");
    CHECK(answer({"stray"}) == "there is no option or argument 'stray' (see --help)");
    CHECK(answer({"--quality", "best"}) == "--quality is 'best'; it must be draft, "
                                           "report or reference (see --help)");
    for (const std::string option : {"--width", "--height", "--rays"})
        for (const std::string value : {"0", "-3", "1.5", "x", "", "99999999999"}) {
            CAPTURE(option);
            CAPTURE(value);
            CHECK(answer({option, value}) != "accepted");
        }
    for (const std::string value : {"-1", "", "x", "1.5", "18446744073709551616"})
        CHECK(answer({"--seed", value}) != "accepted");
    for (const std::string value : {"-1", "1025", "x"})
        CHECK(answer({"--threads", value}) != "accepted");
    for (const std::string word : {"stray", "--width", "-x", "--out"})
        CHECK(answer({word}) != "accepted");
    for (const std::string value : {"nan", "inf", "-inf", "0", "2", "x", ""}) {
        CAPTURE(value);
        double radius = 0.5;
        CommandLine line({"program", "--radius", value});
        line.add("--radius", radius, "How large", 1e-9, 1.0);
        CHECK_THROWS_AS((void)line.parse(), std::invalid_argument);
    }
}

TEST_CASE("command_line: a folder that cannot be used is found before any work") {
    const ScratchFolder folder;
    ScratchFolder::write(folder.file("plain"), "x");
    CHECK(answer({"--out", folder.file("plain")}) == "cannot write into the folder '" +
                                                         folder.file("plain") +
                                                         "' of --out: Not a directory");
    CHECK(answer({"--out", folder.file("plain/below")}) != "accepted");
    CHECK(answer({"--out", ""}) != "accepted");
    CHECK(folder.count() == 1);
}

TEST_CASE("command_line: any word is answered in one line that is not too long") {
    const std::string long_word(5000, 'x');
    for (const std::string& word : {std::string("\x01\x1b[2J\x7f"), std::string("\xff"),
                                    long_word, std::string("1\n2")})
        for (const char* const option :
             {"--width", "--quality", "--out", "--nothing"}) {
            if (option == std::string("--out") && word != long_word) continue;
            const std::string said = answer({option, word});
            CAPTURE(option);
            CHECK(said != "accepted");
            CHECK(said.size() < 1200);
            for (const char c : said) {
                CHECK(static_cast<unsigned char>(c) >= 0x20);
                CHECK(c != '\x7f');
            }
            CHECK(said.find('\xff') == std::string::npos);
            CHECK(said.find("filesystem error") == std::string::npos);
        }
}

TEST_CASE("command_line: run_main turns what is thrown into an exit code") {
    CHECK(run([](CommandLine&) {}) == 0);
    CHECK(run([](CommandLine& line) { (void)line.parse(); }, {"program", "--help"}) ==
          0);
    CHECK(run([](CommandLine& line) { (void)line.parse(); },
              {"program", "--version"}) == 0);
    CHECK(run([](CommandLine& line) { (void)line.parse(); }, {"program", "--nope"}) ==
          2);
    CHECK(run([](CommandLine&) { throw std::runtime_error("no luck."); }) == 2);
    CHECK(run([](CommandLine&) { throw std::bad_alloc(); }) == 2);
    CHECK(run([](CommandLine&) { throw 42; }) == 2);
    CHECK(run([](CommandLine&) { throw examples::Exit{7}; }) == 7);
}

TEST_CASE(
    "command_line: after Ctrl-C the loop stops, nothing is saved, the code is 130") {
    const ScratchFolder folder;
    const std::string out = folder.path.string();
    int blocks = 0;
    bool finished = true;
    const int code = run(
        [&](CommandLine& line) {
            const Options options = line.parse();
            examples::ProgressBar bar("test", true);
            finished = ljus::parallel_blocks(1000,
                                             [&](long long b) {
                                                 ++blocks;
                                                 if (b == 9) std::raise(SIGINT);
                                             },
                                             {.threads = 1, .progress = bar});
            // A program that forgot to look at `finished` cannot save either.
            ljus::save_file(options.path("a.png"), {});
        },
        {"program", "--out", out.c_str()});
    CHECK(code == 130);
    CHECK_FALSE(finished);
    CHECK(blocks == 10);
    CHECK(folder.count() == 0);
    // The next program in this process is not stopped by it.
    CHECK(run([](CommandLine&) {}) == 0);
    // An unhandled Ctrl-C counts as well.
    CHECK(run([](CommandLine&) { std::raise(SIGINT); }) == 130);
    CHECK(run([](CommandLine&) { std::raise(SIGTERM); }) == 143);
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

TEST_CASE("command_line: a setting is its option, its line of help and its value") {
    enum class Kernel { box, cone, unnamed };
    struct {
        float radius = 0.1f;
        std::size_t nearest = 32;
        long long passes = 0;
        Kernel kernel = Kernel::box;
        bool split = false;
        std::string file;
    } set;
    CommandLine line({"program", "--radius", "0", "--kernel", "cone", "--nearest=50",
                      "--height", "7", "--file", "x"});
    line.group("Picture", {"--width", "--height", "--seed"});
    line.group("Photons");
    line.add("--radius", set.radius, "How large", 1e-15, 1e6, true);
    line.add("--nearest", set.nearest, "How many", 2, 512);
    line.add("--passes", set.passes, "How often", 1, 100);
    line.add("--kernel", set.kernel, "Which",
             {{"box", Kernel::box}, {"cone", Kernel::cone}});
    line.add("--split", set.split, "Whether");
    line.add("--file FILE", set.file, "Where");
    (void)line.parse();
    using Values = std::vector<std::pair<std::string, std::string>>;
    // Nobody has asked for passes, and a file is no setting.
    CHECK(line.values("Photons") == Values{{"radius", "0"},
                                           {"nearest", "50"},
                                           {"kernel", "\"cone\""},
                                           {"split", "false"}});
    set = {.radius = 0.3f, .kernel = Kernel::unnamed, .split = true, .file = set.file};
    CHECK(line.values("Photons") ==
          Values{{"radius", "0.3"}, {"nearest", "32"}, {"split", "true"}});
    line.give_again(); // what was not given stays as it is now
    CHECK(set.radius == 0);
    CHECK(set.nearest == 50);
    CHECK(set.kernel == Kernel::cone);
    CHECK(set.split);
    CHECK(set.file == "x");
    CHECK(line.fill({.width = 3, .height = 4, .samples = 5}).samples == 5);
    CHECK(line.values("Picture") ==
          Values{{"seed", "1"}, {"width", "3"}, {"height", "7"}});

    const auto said = [](const char* option, const char* value) {
        float radius = 0.5f;
        Kernel kernel = Kernel::box;
        CommandLine wrong({"program", option, value});
        wrong.add("--radius", radius, "How large", 1e-15, 1e6, true);
        wrong.add("--kernel", kernel, "Which",
                  {{"box", Kernel::box}, {"cone", Kernel::cone}});
        return ljus_test::refusal([&] { (void)wrong.parse(); }, "accepted");
    };
    CHECK(said("--radius", "1e-30") == "--radius is '1e-30'; it must be 0 or a number "
                                       "from 1e-15 to 1e+06 (see --help)");
    CHECK(said("--kernel", "hat") ==
          "--kernel is 'hat'; it must be box or cone (see --help)");
}

TEST_CASE("command_line: the words of an enum are its enumerators") {
    enum class Sampling { random, multi_jittered, sobol };
    const auto words = examples::words_of<Sampling>();
    CHECK(words ==
          examples::Words<Sampling>{{"random", Sampling::random},
                                    {"multi-jittered", Sampling::multi_jittered},
                                    {"sobol", Sampling::sobol}});
    Sampling sampling = Sampling::random;
    std::optional<Quality> preset;
    CommandLine line({"program", "--sampling", "multi-jittered"});
    line.group("Picture");
    line.add("--sampling", sampling, "Where");
    line.add("--preset", preset, "What");
    (void)line.parse();
    CHECK(sampling == Sampling::multi_jittered);
    CHECK_FALSE(preset.has_value());
    CHECK(line.values("Picture").size() == 1); // no preset was chosen
    preset = Quality::reference;
    CHECK(line.values("Picture").back().second == "\"reference\"");
}

TEST_CASE("command_line: two numbers with a character between them") {
    using Two = std::pair<int, int>;
    CHECK(examples::two_numbers("120,80", ',') == Two{120, 80});
    CHECK(examples::two_numbers("-3/16", '/') == Two{-3, 16});
    for (const char* text :
         {"", "3", "3,", ",4", "3/4", "3,4x", "3.0,4", "3,,4", "a,b", "03,4", "+3,4"})
        CHECK_FALSE(examples::two_numbers(text, ',').has_value());
}

TEST_CASE("command_line: what is said of a program that is stopped") {
    const std::string long_text(5000, 'x');
    examples::when_stopped_say(long_text);
    CHECK(examples::last_words_text() == ": " + long_text.substr(0, 997));
    examples::when_stopped_say("two passes are saved");
    CHECK(examples::last_words_text() == std::string(": two passes are saved"));
}

TEST_CASE("command_line: the name of a picture is no folder") {
    const ScratchFolder folder;
    CHECK(answer({"--out", folder.file("a.png").c_str()}) ==
          "--out is " + folder.file("a.png") + "; it must be a folder, for all files");
    for (const char* name : {"a.jpg", "a.exr", "a.PNG", "a.ppm"}) {
        const std::string out = folder.file(name);
        CommandLine line({"program", "--out", out});
        line.file_types({".png", ".hdr", ".pfm"});
        CHECK_THROWS_WITH((void)line.parse(),
                          ("--out is " + out +
                           "; the name of a file must end in .png, .hdr or .pfm, and "
                           "any other is that of a folder")
                              .c_str());
    }
    CHECK(folder.count() == 0);
    for (const char* name : {"v1.2", "results", ".png"})
        CHECK(answer({"--out", folder.file(name).c_str()}) == "accepted");
    std::filesystem::create_directory(folder.path / "b.png"); // it is one already
    CHECK(answer({"--out", folder.file("b.png").c_str()}) == "accepted");
}

TEST_CASE("command_line: a number that is not whole is called so") {
    for (const char* text : {"1.5", "1e3", "0x10", "010", "ten", "", "1 ", "--"})
        CHECK(answer({"--width", text}).find("it must be a whole number") !=
              std::string::npos);
    CHECK(
        answer({"--width", "99999999999999999999"}) ==
        "--width is '99999999999999999999'; it must be a whole number from 1 to 65536 "
        "(see --help)");
}

TEST_CASE("command_line: all options take numbers by one rule") {
    const auto given = [](const std::string& text) {
        double number = -1;
        CommandLine line({"program", "--radius", text});
        line.add("--radius", number, "How large", -1e9, 1e9);
        try {
            (void)line.parse();
        } catch (const std::invalid_argument&) {
            return std::string("refused");
        }
        return std::to_string(number);
    };
    CHECK(given("1e-3") == "0.001000");
    CHECK(given(".5") == "0.500000");
    CHECK(given("5.") == "5.000000");
    CHECK(given("-2.5E+2") == "-250.000000");
    CHECK(given("0.25") == "0.250000");
    for (const char* text :
         {"0x10", " 1", "1 ", "010", "00.5", "+1", "", ".", "-", "1e", "1e+", "e3",
          "1.5.2", "nan", "inf", "1f", "1,5", "1'0"}) {
        CAPTURE(text);
        CHECK(given(text) == "refused");
        CHECK(answer({"--seed", text}) != "accepted");
    }
    for (const char* seed : {"007", "0x1", " 1", "+1", "1.", "1e2"})
        CHECK(answer({"--seed", seed}) != "accepted");
}

#ifdef LJUS_TEST_LITTLE_MEMORY
TEST_CASE("command_line: threads that cannot be had are asked for before they are "
          "needed") {
    // The root may have any number of threads: memory is what ends.
    const ::pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        ::rlimit memory{};
        ::getrlimit(RLIMIT_AS, &memory);
        memory.rlim_cur = ::rlim_t(512) << 20;
        ::setrlimit(RLIMIT_AS, &memory);
        const std::string said = answer({"--threads", "1024"});
        ::_exit(said.find("cannot start 1024 threads: ") == 0 ? 0 : 1);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(status == 0);
    CHECK(answer({"--threads", "8"}) == "accepted");
}
#endif

#if __has_include(<sys/resource.h>)
TEST_CASE("command_line: stacks that are too small or too large are told") {
    const auto with = [](const char* size) {
        ::setenv("OMP_STACKSIZE", size, 1);
        const std::string said = answer({});
        ::unsetenv("OMP_STACKSIZE");
        return said;
    };
    for (const char* const good :
         {"256K", "262144b", "256", "8 M", "1G", " 2m ", "", "x"})
        CHECK(with(good) == "accepted");
    for (const char* const bad :
         {"16k", "255", "1000G", "1025M", "100000B", "-8M", "8X"})
        CHECK(with(bad) == "the environment variable OMP_STACKSIZE is '" +
                               std::string(bad) + "'; it must be from 256K to 1G");
    ::rlimit stack{};
    ::getrlimit(RLIMIT_STACK, &stack);
    ::rlimit small = stack;
    small.rlim_cur = 128 << 10;
    ::setrlimit(RLIMIT_STACK, &small);
    const std::string said = answer({});
    ::setrlimit(RLIMIT_STACK, &stack);
    CHECK(said == "the limit of the stack (ulimit -s) is 128 kilobytes; it must be at "
                  "least 256");
}

namespace {

// The status of a child that runs a program, for waitpid(); -1: it did not start.
template <typename Body>
int status_of(const Body& body, std::vector<const char*> words = {"program"}) {
    const ::pid_t child = ::fork();
    if (child == 0) ::_exit(run(body, std::move(words)));
    int status = 0;
    return child > 0 && ::waitpid(child, &status, 0) == child ? status : -1;
}

// The same, where the standard output of the child is a file: its exit code.
template <typename Body>
int code_into(const char* path, const Body& body,
              std::vector<const char*> words = {"program"}) {
    std::fflush(stdout);
    const int output = ::dup(1);
    REQUIRE(std::freopen(path, "w", stdout) != nullptr);
    const int status = status_of(body, std::move(words));
    std::clearerr(stdout);
    ::dup2(output, 1);
    ::close(output);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

} // namespace

TEST_CASE("command_line: a text that is lost on a full disk is an exit code") {
    if (!std::filesystem::exists("/dev/full")) return;
    const auto parse_line = [](CommandLine& line) { (void)line.parse(); };
    CHECK(code_into("/dev/full", parse_line, {"program", "--help"}) == 2);
    CHECK(code_into("/dev/null", parse_line, {"program", "--help"}) == 0);
    for (const std::size_t bytes : {10u, 5000u, 100'000u}) { // below and above a buffer
        CAPTURE(bytes);
        const auto say = [bytes](CommandLine&) {
            std::fputs(std::string(bytes, 'x').c_str(), stdout);
        };
        CHECK(code_into("/dev/full", say) == 2);
        CHECK(code_into("/dev/null", say) == 0);
    }
    const auto in_the_middle = [](CommandLine&) {
        std::puts("one");
        std::fflush(stdout); // fails, and leaves nothing to flush in the end
    };
    CHECK(code_into("/dev/full", in_the_middle) == 2);
}

TEST_CASE("command_line: a pipe that nobody reads any more ends no work") {
    int ends[2];
    REQUIRE(::pipe(&ends[0]) == 0);
    ::close(ends[0]);
    const ScratchFolder folder;
    const std::string path = folder.file("a.png");
    const int status = status_of([&](CommandLine&) {
        ::dup2(ends[1], 1);
        std::puts("one");
        std::fflush(stdout);
        ljus::save_file(path, {1});
    });
    ::close(ends[1]);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 128 + SIGPIPE);
    CHECK(std::filesystem::exists(path));
}

TEST_CASE("command_line: a signal that is ignored from outside stays so") {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        CAPTURE(signal);
        const auto raise = [signal](CommandLine&) { std::raise(signal); };
        const int heard = status_of(raise);
        CHECK(WIFEXITED(heard));
        CHECK(WEXITSTATUS(heard) == 128 + signal);
        std::signal(signal, SIG_IGN);
        const int ignored = status_of(raise);
        std::signal(signal, SIG_DFL);
        CHECK(WIFEXITED(ignored));
        CHECK(WEXITSTATUS(ignored) == 0);
    }
    // An alarm that the program has not set ends it as any other.
    std::signal(SIGALRM, SIG_DFL);
    const int alarmed = status_of([](CommandLine&) { std::raise(SIGALRM); });
    CHECK(WIFSIGNALED(alarmed));
    CHECK(WTERMSIG(alarmed) == SIGALRM);
}

TEST_CASE("command_line: whoever does not listen to Ctrl-C is stopped two seconds "
          "later") {
    const int status = status_of([](CommandLine&) {
        std::raise(SIGINT);
        for (;;) ::pause();
    });
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 130);
}
#endif

#else

TEST_CASE("command_line: not tested, because CLI11 is not installed") {}

#endif

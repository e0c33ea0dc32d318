#include "cli/explain/exit_codes.hpp"

#include <fmt/format.h>

#include "cli/explain/markdown.hpp"
#include "quadrel/error.hpp"

namespace quadrel::cli {
namespace {

constexpr int number(ExitCode code) { return static_cast<int>(code); }

constexpr ExitCodeText codes[] = {
    {number(ExitCode::ok), "ok"},
    {number(ExitCode::difference), "`compare` found a difference, or what is not legal"},
    {number(ExitCode::usage), "bad command line; an output that would overwrite an input"},
    {number(ExitCode::input),
     "bad or missing input: one line that says file, key, what was found, what was expected"},
    {number(ExitCode::internal),
     "a check of Quadrel's own failed; in a render the message ends with the `probe` line that "
     "shows the quad"},
    {number(ExitCode::output), "output could not be written"},
    {number(ExitCode::try_again), "try again (out of memory)"},
    {129, "ended by SIGHUP"},
    {130, "ended by SIGINT (Ctrl-C)"},
    {143, "ended by SIGTERM"},
};

}  // namespace

std::span<const ExitCodeText> exit_codes() { return codes; }

std::string exit_code_help() {
    std::string text = "Exit codes:";
    for (const ExitCodeText& row : codes)
        text += fmt::format("\n  {:<4}{}", row.code, plain_text(row.meaning));
    return text;
}

}  // namespace quadrel::cli

#pragma once

/// \file support/refusal.hpp
/// \brief The messages with which calls are refused.

#include <concepts>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

namespace ljus_test {

/// The message with which a call is refused.
/// \param otherwise  The result if the call succeeds.
template <typename Error = std::invalid_argument, std::invocable Call>
std::string refusal(Call call, const char* otherwise = "") {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return otherwise;
}

/// The reason why a call cannot read a file, without "cannot read 'a.pfm': "; "loaded"
/// if it can.
template <std::invocable Load>
std::string why_not_read(const std::string& path, Load load) {
    try {
        load();
    } catch (const std::runtime_error& error) {
        const std::string text = error.what();
        const std::string start = "cannot read '" + path + "': ";
        CHECK(text.starts_with(start));
        return text.substr(start.size());
    }
    return "loaded";
}

} // namespace ljus_test

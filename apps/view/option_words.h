// SPDX-License-Identifier: Apache-2.0
/// \file
/// What is shown, as the options of `tetralux render` that draw it: there is no second description that could differ.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tetralux::apps::view {

/// One option, "--name" or "--name=value".
struct OptionWord {
    std::string name;                  ///< with its dashes
    std::optional<std::string> value;  ///< nothing: a flag
    bool operator==(const OptionWord&) const = default;
};

/// A mesh and options in the order in which they were given.
class OptionWords {
public:
    std::string mesh;  ///< file or generated field

    bool has(std::string_view name) const;
    std::string valueOf(std::string_view name, std::string_view otherwise = "") const;  ///< of the last of that name
    std::vector<std::string> valuesOf(std::string_view name) const;                     ///< of all of that name

    /// In the place of all of that name.
    void set(const std::string& name, std::optional<std::string> value = {});
    /// Beside others of that name.
    void add(const std::string& name, std::optional<std::string> value = {});
    void remove(std::string_view name);
    void setFlag(const std::string& name, bool on);

    const std::vector<OptionWord>& options() const { return options_; }

    /// The words of a command line after "tetralux render".
    std::vector<std::string> arguments() const;
    /// A line for a shell that draws this to `output`.
    std::string commandLine(const std::string& output) const;

    bool operator==(const OptionWords&) const = default;

private:
    std::vector<OptionWord> options_;
};

/// As a shell reads it back: in single quotes where it holds anything but letters, digits and _-+=.,:/@%.
std::string shellQuoted(const std::string& word);

/// Splits a line as shells do: at spaces, but for those in '…' and "…" or after a backslash; # begins a comment.
/// \throws std::runtime_error for a quote that does not end.
std::vector<std::string> shellSplit(const std::string& line);

}  // namespace tetralux::apps::view

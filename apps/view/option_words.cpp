// SPDX-License-Identifier: Apache-2.0
#include <apps/view/option_words.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <utility>

namespace tetralux::apps::view {

bool OptionWords::has(std::string_view name) const {
    return std::any_of(options_.begin(), options_.end(), [&](const OptionWord& word) { return word.name == name; });
}

std::vector<std::string> OptionWords::valuesOf(std::string_view name) const {
    std::vector<std::string> values;
    for (const OptionWord& word : options_)
        if (word.name == name) values.push_back(word.value.value_or(""));
    return values;
}

std::string OptionWords::valueOf(std::string_view name, std::string_view otherwise) const {
    const std::vector<std::string> values = valuesOf(name);
    return values.empty() ? std::string(otherwise) : values.back();
}

void OptionWords::set(const std::string& name, std::optional<std::string> value) {
    const auto first =
        std::find_if(options_.begin(), options_.end(), [&](const OptionWord& word) { return word.name == name; });
    if (first == options_.end()) return add(name, std::move(value));
    first->value = std::move(value);
    options_.erase(std::remove_if(first + 1, options_.end(), [&](const OptionWord& word) { return word.name == name; }),
                   options_.end());
}

void OptionWords::add(const std::string& name, std::optional<std::string> value) {
    options_.push_back({name, std::move(value)});
}

void OptionWords::remove(std::string_view name) {
    std::erase_if(options_, [&](const OptionWord& word) { return word.name == name; });
}

void OptionWords::setFlag(const std::string& name, bool on) {
    if (on)
        set(name);
    else
        remove(name);
}

std::vector<std::string> OptionWords::arguments() const {
    std::vector<std::string> words{mesh};
    for (const OptionWord& word : options_) words.push_back(word.value ? word.name + "=" + *word.value : word.name);
    return words;
}

std::string OptionWords::commandLine(const std::string& output) const {
    std::string line = "tetralux render";
    for (const std::string& word : arguments()) (line += ' ') += shellQuoted(word);
    return line + " -o " + shellQuoted(output);
}

std::string shellQuoted(const std::string& word) {
    const auto plain = [](unsigned char letter) {
        return std::isalnum(letter) != 0 ||
               std::string_view("_-+=.,:/@%").find(static_cast<char>(letter)) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
    std::string quoted = "'";
    for (const char letter : word) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return quoted + "'";
}

std::vector<std::string> shellSplit(const std::string& line) {
    std::vector<std::string> words;
    std::optional<std::string> word;
    char quote = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char letter = line[i];
        if (quote != 0) {
            if (letter == quote)
                quote = 0;
            else if (letter == '\\' && quote == '"' && i + 1 < line.size())
                *word += line[++i];
            else
                *word += letter;
        } else if (letter == '\'' || letter == '"') {
            quote = letter;
            if (!word) word.emplace();
        } else if (std::isspace(static_cast<unsigned char>(letter)) != 0) {
            if (word) words.push_back(*std::exchange(word, std::nullopt));
        } else if (letter == '#' && !word) {
            break;
        } else {
            if (!word) word.emplace();
            *word += letter == '\\' && i + 1 < line.size() ? line[++i] : letter;
        }
    }
    if (quote != 0) throw std::runtime_error("a quote does not end; close it");
    if (word) words.push_back(*word);
    return words;
}

}  // namespace tetralux::apps::view

// SPDX-License-Identifier: Apache-2.0
/// \file
/// What is shown, how it came to be so, and the commands that change it. Knows neither windows nor engines.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <apps/view/option_words.h>
#include <preint/transfer_function.h>
#include <projection/core/camera.h>

namespace tetralux::apps::view {

/// What commands ask of the picture that is there.
class Shown {
public:
    virtual ~Shown() = default;
    virtual projection::Camera camera() = 0;          ///< of the state as it is
    virtual preint::TransferFunction function() = 0;  ///< likewise, in absolute units
    virtual std::vector<double> times() = 0;          ///< of all steps; empty: the mesh is no series
    virtual glm::dvec3 pointUnder(
        const glm::dvec2&) = 0;  ///< the first point that shows there; \throws where none does
};

class ViewState {
public:
    explicit ViewState(OptionWords words) : words_(std::move(words)) {}

    const OptionWords& words() const { return words_; }

    /// Runs one command, such as {"turn", "30", "0"}; viewCommands() lists them. \returns false where there is no
    /// command of that name. \throws std::runtime_error for arguments that will not do; the state is then as before.
    bool apply(const std::vector<std::string>& command, Shown& shown);

    /// Takes the words for the state; until the next mark() it can be undone in one step with what follows.
    void change(OptionWords words);
    /// What comes now is to be undone apart from what was before: a hand took up something else.
    void mark() { marked_ = true; }
    /// Says the same in other words: nothing to undo.
    void reword(OptionWords words) { words_ = std::move(words); }

    bool canUndo() const { return !past_.empty(); }
    bool canRedo() const { return !future_.empty(); }
    void undo();
    void redo();

private:
    OptionWords words_;
    std::vector<OptionWords> past_, future_;
    std::map<std::string, projection::Camera> stored_;
    bool marked_ = true;
};

struct ViewCommand {
    std::string name, arguments, help;
};

/// Those of ViewState::apply, for help.
std::vector<ViewCommand> viewCommands();

}  // namespace tetralux::apps::view

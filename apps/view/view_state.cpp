// SPDX-License-Identifier: Apache-2.0
#include <apps/view/view_state.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <apps/view/camera_moves.h>
#include <apps/view/transfer_nodes.h>
#include <projection/core/fitted_view.h>

namespace tetralux::apps::view {

namespace {

constexpr std::size_t mostPast = 500;

/// The arguments of one command, taken one after the other.
class Arguments {
public:
    explicit Arguments(const std::vector<std::string>& words) : words_(words) {}

    bool more() const { return next_ < words_.size(); }
    std::string word(const char* what) {
        if (!more()) throw std::runtime_error(fmt::format("{}: {} is missing", words_.front(), what));
        return words_[next_++];
    }
    double number(const char* what) {
        const std::string text = word(what);
        double value = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
            throw std::runtime_error(fmt::format("{}: '{}' is no number; give {}", words_.front(), text, what));
        return value;
    }
    glm::dvec2 pair(const char* first, const char* second) {
        const double x = number(first);
        return {x, number(second)};
    }
    glm::dvec3 color() {
        const double r = number("red"), g = number("green");
        return {r, g, number("blue")};
    }
    std::size_t index(const char* what) {
        const double value = number(what);
        if (value < 0.0 || value > 1e9 || value != std::floor(value))
            throw std::runtime_error(
                fmt::format("{}: {} is no {}; give a whole number from 0", words_.front(), value, what));
        return static_cast<std::size_t>(value);
    }
    void end() const {
        if (more())
            throw std::runtime_error(fmt::format("{}: '{}' is one word too many", words_.front(), words_[next_]));
    }

private:
    const std::vector<std::string>& words_;
    std::size_t next_ = 1;
};

struct Context {
    OptionWords& words;
    Shown& shown;
    std::map<std::string, projection::Camera>& stored;
};

using Run = std::function<void(Arguments&, Context&)>;

struct Entry {
    ViewCommand command;
    Run run;
};

/// A command that gives another camera.
template <class Move>
Run moving(Move move) {
    return [move](Arguments& arguments, Context& context) {
        setCamera(context.words, move(arguments, context.shown.camera()));
    };
}

/// A command that changes the transfer function.
template <class Edit>
Run editing(Edit edit) {
    return [edit](Arguments& arguments, Context& context) {
        preint::TransferFunction function = context.shown.function();
        edit(arguments, function);
        setFunction(context.words, function);
    };
}

std::string optionName(Arguments& arguments) {
    const std::string name = arguments.word("an option");
    return name.starts_with("-") ? name : "--" + name;
}

std::optional<std::string> optionalWord(Arguments& arguments) {
    return arguments.more() ? std::optional(arguments.word("a value")) : std::nullopt;
}

void seeFrom(OptionWords& words, const std::string& side) {
    const bool parallel = words.has("--height") || words.has("--orthographic");
    removeCamera(words);
    if (!side.empty()) {
        projection::namedView(side);  // refuses other names
        words.set("--view", side);
    }
    words.setFlag("--orthographic", parallel);
}

/// The direction stays, and all that shows is held.
void fit(Arguments&, Context& context) {
    const projection::Camera camera = context.shown.camera();
    removeCamera(context.words);
    const glm::dvec3 forward = camera.target - camera.eye;
    context.words.set("--direction", fmt::format("{},{},{}", forward.x, forward.y, forward.z));
    context.words.set("--up", fmt::format("{},{},{}", camera.up.x, camera.up.y, camera.up.z));
    context.words.setFlag("--orthographic", camera.orthographic());
}

void step(Arguments& arguments, Context& context) {
    const std::vector<double> times = context.shown.times();
    const std::size_t number = arguments.index("step");
    if (number >= times.size())
        throw std::runtime_error(fmt::format("step {}: there are {}, counted from 0", number, times.size()));
    context.words.set("--time", fmt::format("{}", times[number]));
}

void window(Arguments& arguments, Context& context) {
    const glm::dvec2 ends = arguments.pair("low", "high");
    if (!(ends.x < ends.y)) throw std::runtime_error(fmt::format("window: {} is not below {}", ends.x, ends.y));
    context.words.remove("--window");
    context.words.set("--range", fmt::format("{},{}", ends.x, ends.y));
}

std::vector<Entry> cameraEntries() {
    return {
        {{"turn", "RIGHT UP", "the eye goes round the target, degrees; up stays"},
         moving([](Arguments& a, const projection::Camera& c) { return turntable(c, a.pair("degrees", "degrees")); })},
        {{"trackball", "RIGHT UP", "the same about the picture's own axes"},
         moving([](Arguments& a, const projection::Camera& c) { return trackball(c, a.pair("degrees", "degrees")); })},
        {{"roll", "DEGREES", "the picture turns clockwise"},
         moving([](Arguments& a, const projection::Camera& c) { return rolled(c, a.number("degrees")); })},
        {{"pan", "RIGHT DOWN", "the picture moves, pixels"},
         moving([](Arguments& a, const projection::Camera& c) { return panned(c, a.pair("pixels", "pixels")); })},
        {{"zoom", "FACTOR [X Y]", "nearer by a factor, to the pixel X, Y"},
         moving([](Arguments& a, const projection::Camera& c) {
             const double factor = a.number("a factor");
             if (!(factor > 0.0)) throw std::runtime_error(fmt::format("zoom {}: give a factor above 0", factor));
             return zoomedTo(c, factor, a.more() ? a.pair("x", "y") : 0.5 * (glm::dvec2(c.width, c.height) - 1.0));
         })},
        {{"centre", "X Y", "the first point that shows at the pixel X, Y comes to the middle"},
         [](Arguments& a, Context& c) {
             setCamera(c.words, centred(c.shown.camera(), c.shown.pointUnder(a.pair("x", "y"))));
         }},
        {{"projection", "", "perspective becomes parallel, and back"},
         moving([](Arguments&, const projection::Camera& c) { return withOtherProjection(c); })},
        {{"fit", "", "what shows is held as tightly as the picture allows, from the same side"}, fit},
        {{"view", "[SIDE]", "from a side, as --view has them; without: the first view"},
         [](Arguments& a, Context& c) { seeFrom(c.words, a.more() ? a.word("a side") : ""); }},
        {{"store", "NAME", "keeps the view under a name or number"},
         [](Arguments& a, Context& c) { c.stored[a.word("a name")] = c.shown.camera(); }},
        {{"recall", "NAME", "back to that view"},
         [](Arguments& a, Context& c) {
             const std::string name = a.word("a name");
             const auto found = c.stored.find(name);
             if (found == c.stored.end())
                 throw std::runtime_error(fmt::format("recall {}: no view was stored so", name));
             setCamera(c.words, found->second);
         }},
    };
}

std::vector<Entry> functionEntries() {
    using Function = preint::TransferFunction;
    return {
        {{"node", "SCALAR EXTINCTION", "a new node of the transfer function"}, editing([](Arguments& a, Function& f) {
             const glm::dvec2 at = a.pair("a scalar", "an extinction");
             addNode(f, at.x, at.y);
         })},
        {{"move-node", "N SCALAR EXTINCTION", "node N, counted from 0, between its neighbours"},
         editing([](Arguments& a, Function& f) {
             const std::size_t node = a.index("node");
             const glm::dvec2 to = a.pair("a scalar", "an extinction");
             moveNode(f, node, to.x, to.y);
         })},
        {{"remove-node", "N", "node N goes"},
         editing([](Arguments& a, Function& f) { removeNode(f, a.index("node")); })},
        {{"color", "SCALAR R G B", "the colour there"}, editing([](Arguments& a, Function& f) {
             const double scalar = a.number("a scalar");
             setColor(f, scalar, a.color());
         })},
        {{"isosurface", "SCALAR OPACITY R G B", "a new isosurface"}, editing([](Arguments& a, Function& f) {
             const glm::dvec2 at = a.pair("a scalar", "an opacity");
             addIsosurface(f, {at.x, at.y, a.color()});
         })},
        {{"remove-isosurface", "N", "isosurface N goes, counted from 0"},
         editing([](Arguments& a, Function& f) { removeIsosurface(f, a.index("isosurface")); })},
        {{"density", "FACTOR", "extinction times FACTOR"},
         editing([](Arguments& a, Function& f) { scaleExtinction(f, a.number("a factor")); })},
        {{"window", "LOW HIGH", "colours and opacity over these scalars"}, window},
    };
}

std::vector<Entry> optionEntries() {
    return {
        {{"set", "OPTION [VALUE]", "an option of `tetralux render` in the place of those of its name: set mode mip"},
         [](Arguments& a, Context& c) {
             const std::string name = optionName(a);
             c.words.set(name, optionalWord(a));
         }},
        {{"add", "OPTION VALUE", "another of its name: add slice 0,0,0,1,0,0"},
         [](Arguments& a, Context& c) {
             const std::string name = optionName(a);
             c.words.add(name, optionalWord(a));
         }},
        {{"unset", "OPTION", "none of that name"}, [](Arguments& a, Context& c) { c.words.remove(optionName(a)); }},
        {{"step", "N", "another step of a series, counted from 0"}, step},
        {{"open", "MESH", "another mesh, all else as it is but for the view"},
         [](Arguments& a, Context& c) {
             removeCamera(c.words);
             c.words.mesh = a.word("a mesh");
         }},
    };
}

const std::vector<Entry>& entries() {
    static const std::vector<Entry> all = [] {
        std::vector<Entry> list = cameraEntries();
        for (std::vector<Entry>& more : std::array{functionEntries(), optionEntries()})
            std::move(more.begin(), more.end(), std::back_inserter(list));
        return list;
    }();
    return all;
}

}  // namespace

bool ViewState::apply(const std::vector<std::string>& command, Shown& shown) {
    if (command.empty()) return true;
    if (command.front() == "undo") return undo(), true;
    if (command.front() == "redo") return redo(), true;
    const auto& all = entries();
    const auto entry =
        std::find_if(all.begin(), all.end(), [&](const Entry& one) { return one.command.name == command.front(); });
    if (entry == all.end()) return false;
    OptionWords words = words_;
    Arguments arguments(command);
    Context context{words, shown, stored_};
    entry->run(arguments, context);
    arguments.end();
    change(std::move(words));
    return true;
}

void ViewState::change(OptionWords words) {
    if (words == words_) return;
    if (marked_) {
        past_.push_back(words_);
        if (past_.size() > mostPast) past_.erase(past_.begin());
    }
    marked_ = false;
    future_.clear();
    words_ = std::move(words);
}

void ViewState::undo() {
    if (past_.empty()) return;
    future_.push_back(std::exchange(words_, past_.back()));
    past_.pop_back();
    marked_ = true;
}

void ViewState::redo() {
    if (future_.empty()) return;
    past_.push_back(std::exchange(words_, future_.back()));
    future_.pop_back();
    marked_ = true;
}

std::vector<ViewCommand> viewCommands() {
    std::vector<ViewCommand> commands;
    for (const Entry& entry : entries()) commands.push_back(entry.command);
    commands.push_back({"undo", "", "one change back"});
    commands.push_back({"redo", "", "and forth"});
    return commands;
}

}  // namespace tetralux::apps::view

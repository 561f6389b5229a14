// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <apps/plot_canvas.h>

namespace tetralux::apps {

namespace {

std::string escaped(const std::string& text) {
    std::string result;
    for (const char letter : text) {
        switch (letter) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += letter;
        }
    }
    return result;
}

std::string pointList(const std::vector<glm::dvec2>& points) {
    std::string list;
    for (const glm::dvec2& p : points) list += fmt::format("{}{:.1f},{:.1f}", list.empty() ? "" : " ", p.x, p.y);
    return list;
}

class SvgCanvas final : public PlotCanvas {
public:
    SvgCanvas(int width, int height)
        : text_(fmt::format(
              "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
              "font-family=\"DejaVu Sans, Arial, sans-serif\">\n"
              "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
              width, height)) {}

    void polyline(const std::vector<glm::dvec2>& points, const std::string& color, double width) override {
        text_ += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
                             pointList(points), color, width);
    }

    void polygon(const std::vector<glm::dvec2>& corners, const std::string& fill, const std::string& edge,
                 const std::string& note) override {
        text_ += fmt::format("<polygon points=\"{}\" fill=\"{}\" stroke=\"{}\">", pointList(corners), fill, edge);
        if (!note.empty()) text_ += fmt::format("<title>{}</title>", escaped(note));
        text_ += "</polygon>\n";
    }

    void text(const glm::dvec2& at, const std::string& text, double size, TextAnchor anchor, bool upwards) override {
        static constexpr const char* anchors[] = {"start", "middle", "end"};
        text_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", at.x,
                             at.y, size, anchors[static_cast<int>(anchor)],
                             upwards ? fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", at.x, at.y) : "",
                             escaped(text));
    }

    std::string bytes() override { return text_ + "</svg>\n"; }

private:
    std::string text_;
};

}  // namespace

std::unique_ptr<PlotCanvas> makeSvgCanvas(int width, int height) {
    return std::make_unique<SvgCanvas>(width, height);
}

}  // namespace tetralux::apps

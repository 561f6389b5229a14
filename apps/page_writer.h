// SPDX-License-Identifier: Apache-2.0
/// \file
/// One text as a Markdown page or as a manual page (roff, man(7)). Within paragraphs and terms `code` stands between
/// backticks.
#pragma once

#include <string>
#include <string_view>

namespace tetralux::apps {

/// What is said in a line without a full stop, as a sentence.
std::string sentence(std::string_view text);

class PageWriter {
public:
    virtual ~PageWriter() = default;
    /// The page's name, section 1 of the manual, and what it is about in one line without a full stop.
    virtual void title(std::string_view name, std::string_view about, std::string_view version) = 0;
    virtual void heading(std::string_view text) = 0;
    virtual void subheading(std::string_view text) = 0;
    virtual void paragraph(std::string_view text) = 0;
    virtual void code(std::string_view lines) = 0;  ///< as they are; each ends with a line feed
    /// An entry of a list: a term (code, whole) and what it means.
    virtual void entry(std::string_view term, std::string_view meaning) = 0;

    const std::string& text() const { return text_; }

protected:
    std::string text_;
};

class MarkdownWriter final : public PageWriter {
public:
    void title(std::string_view name, std::string_view about, std::string_view version) override;
    void heading(std::string_view text) override;
    void subheading(std::string_view text) override;
    void paragraph(std::string_view text) override;
    void code(std::string_view lines) override;
    void entry(std::string_view term, std::string_view meaning) override;

private:
    void beginBlock();

    bool inList_ = false;
};

class ManWriter final : public PageWriter {
public:
    void title(std::string_view name, std::string_view about, std::string_view version) override;
    void heading(std::string_view text) override;
    void subheading(std::string_view text) override;
    void paragraph(std::string_view text) override;
    void code(std::string_view lines) override;
    void entry(std::string_view term, std::string_view meaning) override;
};

}  // namespace tetralux::apps

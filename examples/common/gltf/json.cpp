// SPDX-License-Identifier: MIT
#include "common/gltf/json.hpp"

#include "common/gltf/report.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace nephroid::examples::gltf {
namespace {

constexpr std::size_t deepest = 100;
constexpr std::string_view images = "images";
constexpr std::size_t most_materials = 65536; // 2 KiB each in tinygltf, from three characters

/// Follows the brackets and the strings of a JSON text.
class Scanner {
public:
    explicit Scanner(std::span<char> text) : text_(text) {}

    JsonSurvey scan() {
        for (std::size_t i = 0; i < text_.size(); ++i) {
            switch (text_[i]) {
            case '{':
            case '[':
                enter(text_[i]);
                break;
            case '}':
            case ']':
                leave();
                break;
            case ',':
                at_key_ = !open_.empty() && open_.back() == '{';
                at_uri_ = at_offset_ = false;
                if (open_ == "{[" && section_ == images && ++image_commas_ > survey_.images)
                    fail({"image ", std::to_string(survey_.images), " is not an object"});
                break;
            case ':':
                at_key_ = false;
                break;
            case '"': {
                const std::size_t end = closing_quote(i);
                if (end == text_.size())
                    return survey_;
                read_string(text_.subspan(i + 1, end - i - 1));
                i = end;
                break;
            }
            case '-':
                if (at_offset_)
                    fail({"a byteOffset is negative"}); // which newer releases of tinygltf take for none
                break;
            default:
                break;
            }
        }
        return survey_;
    }

private:
    void enter(char bracket) {
        open_ += bracket;
        if (open_.size() > deepest)
            fail({"its JSON is nested more than ", std::to_string(deepest), " deep"});
        at_key_ = bracket == '{';
        at_uri_ = at_offset_ = false;
        if (in_element_of("buffers"))
            has_uri_ = false;
        if (in_element_of("materials") && ++materials_ > most_materials)
            fail({"more than ", std::to_string(most_materials), " materials"});
        if (in_element_of(images))
            ++survey_.images;
    }

    void leave() {
        if (in_element_of("buffers") && !has_uri_)
            ++survey_.buffers_without_uri;
        if (!open_.empty())
            open_.pop_back();
        at_key_ = at_uri_ = at_offset_ = false;
    }

    [[nodiscard]] std::size_t closing_quote(std::size_t opening) const {
        std::size_t i = opening + 1;
        while (i < text_.size() && text_[i] != '"')
            i += text_[i] == '\\' ? 2u : 1u;
        return (std::min)(i, text_.size());
    }

    void read_string(std::span<char> content) {
        const std::string_view word(content.data(), content.size());
        at_offset_ = at_key_ && word == "byteOffset" && (section_ == "bufferViews" || section_ == "accessors");
        if (at_key_ && open_ == "{")
            enter_section(content);
        else if (at_key_ && in_element_of("buffers")) {
            require_plain(word);
            at_uri_ = word == "uri";
            if (at_uri_)
                has_uri_ = false; // of two the later one counts
        } else if (at_uri_) {
            has_uri_ = !word.empty();
            at_uri_ = false;
        } else if (open_ == "{[") {
            if (section_ == "extensionsRequired")
                survey_.required_extensions.emplace_back(word);
            else if (section_ == "extensionsUsed")
                survey_.used_extensions.emplace_back(word);
        }
    }

    void enter_section(std::span<char> name) {
        section_.assign(name.begin(), name.end());
        require_plain(section_);
        constexpr std::string_view kept = "extras";
        static_assert(images.size() == kept.size());
        if (section_ == images) {
            std::copy(kept.begin(), kept.end(), name.begin());
            return;
        }
        constexpr std::array<std::string_view, 3> unread{kept, "skins", "animations"};
        if (std::find(unread.begin(), unread.end(), section_) == unread.end())
            return;
        if (section_ == "animations")
            survey_.has_animations = true;
        name[0] = '_';
    }

    static void require_plain(std::string_view key) {
        if (key.find('\\') != std::string_view::npos)
            fail({"the property \"", key, "\" is spelt with escapes, which are not read there; write it out"});
    }

    [[nodiscard]] bool in_element_of(std::string_view section) const { return open_ == "{[{" && section_ == section; }

    std::span<char> text_;
    JsonSurvey survey_;
    std::string open_;    ///< the brackets around, outermost first
    std::string section_; ///< the last key of the outermost object
    bool at_key_ = false; ///< the next string is a key
    bool at_uri_ = false; ///< the next string is a buffer's uri
    bool has_uri_ = false;
    bool at_offset_ = false; ///< the next value is a byteOffset
    std::size_t materials_ = 0;
    std::size_t image_commas_ = 0; ///< between images
};
} // namespace

JsonSurvey prepare_json(std::span<char> text) { return Scanner(text).scan(); }

} // namespace nephroid::examples::gltf

// Nested JSON as a parser's events: where in the file it is, and what may come there. Neither the
// size of the text nor its depth takes stack or a second copy.
#pragma once

#include "render/prepare.h"
#include "saved/tree_assembly.h"
#include "saved/tree_leaf.h"
#include "util/error.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sahl {

/// Fills in the texels and the trees. All errors are badInput with line and column.
class TreeEvents : public nlohmann::json_sax<nlohmann::json> {
public:
    /// Called with the value of "scene": its first byte and where it ends.
    using ReadScene = std::function<void(size_t begin, size_t end)>;

    TreeEvents(const std::string& file, std::string_view text, ReadScene readScene,
               PreparedScene& prepared);

    /// Parses all of the text.
    void read();

    bool null() override;
    bool boolean(bool value) override;
    bool number_integer(number_integer_t value) override;
    bool number_unsigned(number_unsigned_t value) override;
    bool number_float(number_float_t value, const string_t& text) override;
    bool string(string_t& value) override;
    bool binary(binary_t& value) override;
    bool start_object(std::size_t size) override;
    bool end_object() override;
    bool start_array(std::size_t size) override;
    bool end_array() override;
    bool key(string_t& name) override;
    bool parse_error(std::size_t position, const std::string& token,
                     const nlohmann::detail::exception& error) override;

private:
    /// Where in the file the parser is: the values of its keys, or between them.
    enum class Part { file, scene, texels, objects, root };

    std::string path() const;
    std::string where(size_t offset) const;
    Error wrong(const std::string& finding) const;
    template <class Action>
    bool placed(Action action) const;

    bool isWithinScene() const;
    bool wordOrNull() const;
    bool descend();
    bool ascend();
    bool real(float value);
    void fileKey(const std::string& name);
    void finishTexel();
    bool textureTexel(uint64_t value);
    void finishLeaf();
    std::string faultOf(const InstanceLeaf& leaf) const;
    void addInstance(const InstanceLeaf& leaf);
    void openGroup();
    void closeGroup();
    void finishObject();

    const std::string& file_;
    std::string_view text_;
    ReadScene readScene_;
    PreparedScene& prepared_;

    size_t consumed_ = 0;  ///< [bytes]
    Part part_ = Part::file;
    bool fileOpen_ = false;
    size_t keysRead_ = 0;    ///< of the file itself
    size_t sceneBegin_ = 0;  ///< [bytes]
    size_t depth_ = 0;       ///< arrays (in "scene" also objects) within the present value
    bool listOpen_ = false;  ///< that of the objects
    size_t groups_ = 0;      ///< open ones
    bool inLeaf_ = false;
    TreeLeaf leaf_;
    vec4 texel_ = {};
    int components_ = 0;  ///< of the texel
    TreeAssembly tree_;   ///< under way
    std::vector<Bvh> objects_;
    std::vector<InstanceLeaf> instances_;
};

}  // namespace sahl

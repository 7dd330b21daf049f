// The parts of the page that are the same for all comparisons: host/compare/page/.
#pragma once

namespace sahl {

extern const char* const PAGE_HTML;  ///< with places {{style}}, {{script}}, {{comparison}}, {{planes}}
extern const char* const PAGE_STYLE;
extern const char* const PAGE_SCRIPT;

}  // namespace sahl

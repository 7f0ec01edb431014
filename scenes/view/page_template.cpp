#include "scenes/view/page_template.h"

#include <stdexcept>

// The assembler reads the file: no copy of it as C++ has to be made and compiled.
asm(".pushsection .rodata\n"
    ".globl tact_view_page\n"
    ".hidden tact_view_page\n"
    "tact_view_page:\n"
    ".incbin \"" TACT_VIEW_PAGE
    "\"\n"
    ".globl tact_view_page_end\n"
    ".hidden tact_view_page_end\n"
    "tact_view_page_end:\n"
    ".byte 0\n"
    ".popsection\n");

extern "C" {
extern const char tact_view_page[];
extern const char tact_view_page_end[];
}

namespace tact::scenes {

PageTemplate page_template() {
  constexpr std::string_view kMark = "<!--tact:data-->";
  const std::string_view page(tact_view_page, static_cast<std::size_t>(tact_view_page_end - tact_view_page));
  const std::size_t mark = page.find(kMark);
  if (mark == std::string_view::npos) throw std::logic_error("the page of viewer/ has no place for data");
  return {page.substr(0, mark), page.substr(mark + kMark.size())};
}

}  // namespace tact::scenes

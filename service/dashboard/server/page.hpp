#pragma once
// The files of the page, as the build made them, in the program itself.

#include <span>
#include <string_view>

namespace adstar::dashboard {

struct PageFile {
  std::string_view path;  ///< "/index.html"
  std::string_view content_type;
  std::string_view bytes;
};

/// Empty: built without the page (choose_page.cmake).
std::span<const PageFile> page_files();

}  // namespace adstar::dashboard

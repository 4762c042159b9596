// Stands for the page in a build without npm, or without its registry.

#include "service/dashboard/server/page.hpp"

namespace adstar::dashboard {

std::span<const PageFile> page_files() { return {}; }

}  // namespace adstar::dashboard

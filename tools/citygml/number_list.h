// Lists of numbers that are separated otherwise than GML has it.
#pragma once

#include <string>
#include <string_view>

namespace nightcity::citygml {

/// Returns the list with blanks as separators: for one that has blanks of Unicode, semicolons, or
/// commas within tuples ("1,2,3 4,5,6"). Decimal commas stay, as does all that it cannot tell.
std::string mend_number_list(std::string_view text);

}  // namespace nightcity::citygml

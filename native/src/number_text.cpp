// SPDX-License-Identifier: GPL-3.0-or-later
#include "number_text.h"

#include <cmath>
#include <locale>
#include <sstream>

namespace mrc {

std::string number_text(double value, int digits) {
    if (std::isnan(value)) return "nan";  // some systems print its sign, or its kind
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(digits);
    text << value;
    return text.str();
}

}  // namespace mrc

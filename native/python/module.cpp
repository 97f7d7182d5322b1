// SPDX-License-Identifier: GPL-3.0-or-later
// The Python module: checks and converts arrays, releases the interpreter's lock, calls. No algorithm lives here.
#include "bindings.h"

#include <mrc/errors.h>

PYBIND11_MODULE(mrcontour, module) {
    namespace py = pybind11;
    module.doc() =
        "Minimum ratio contours: moves a rough loop of edges on a mesh to where the part really ends.\n\n"
        "Make a Surface from arrays, then call optimize. Lengths are in the mesh's own unit, curvatures in one over it, angles\n"
        "in radians. Invalid input is a ValueError that names the elements; unknown options are a TypeError.";
    module.attr("__version__") = MRC_VERSION;
    py::register_exception<mrc::Infeasible>(module, "Infeasible", PyExc_ValueError).attr("__doc__") =
        "No contour of the band has all required elements (4.4). The message says where the search stops.";
    py::register_exception<mrc::TooLarge>(module, "TooLarge", PyExc_ValueError).attr("__doc__") =
        "The search would take more memory than there is. The message says what to lower.";
    mrc_python::bind_surface(module);
    mrc_python::bind_options(module);
    mrc_python::bind_results(module);
    mrc_python::bind_functions(module);
}

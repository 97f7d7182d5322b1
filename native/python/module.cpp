// SPDX-License-Identifier: GPL-3.0-or-later
// The Python module: checks and converts arrays, releases the interpreter's lock, calls. No algorithm lives here. All classes are
// local to it (py::module_local), because a Blender with two copies of the add-on loads two copies of the module.
#include "bindings.h"

PYBIND11_MODULE(mrcontour, module) {
    module.doc() =
        "Minimum ratio contours: moves a rough loop of edges on a mesh to where the part really ends.\n\n"
        "Make a Surface from arrays, then call optimize. Lengths are in the mesh's own unit, curvatures in one over it, angles\n"
        "in radians. Invalid input is an InvalidInput, a ValueError that names the elements; unknown options are a TypeError.";
    module.attr("__version__") = MRC_VERSION;
    mrc_python::bind_errors(module);
    mrc_python::bind_surface(module);
    mrc_python::bind_options(module);
    mrc_python::bind_contour(module);
    mrc_python::bind_results(module);
    mrc_python::bind_functions(module);
}

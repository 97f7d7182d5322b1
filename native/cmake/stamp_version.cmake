# SPDX-License-Identifier: GPL-3.0-or-later
# Sets the version of the installed add-on, whose source says 0.0.0. MRC_ADDON and MRC_VERSION must be set.
string(REPLACE "." ", " numbers ${MRC_VERSION})
foreach(name __init__.py blender_manifest.toml)
    set(file ${CMAKE_INSTALL_PREFIX}/${MRC_ADDON}/${name})
    file(READ ${file} text)
    string(REPLACE "\"version\": (0, 0, 0)" "\"version\": (${numbers})" text "${text}")
    string(REPLACE "\nversion = \"0.0.0\"" "\nversion = \"${MRC_VERSION}\"" text "${text}")
    file(WRITE ${file} "${text}")
endforeach()

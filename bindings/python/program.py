#!/usr/bin/env python3
"""The program `skelgen`: it is in the package's module, which is loaded alone, as to load numpy takes longer."""

import importlib.util
import os
import signal
import sys
from importlib.machinery import PathFinder

package = importlib.util.find_spec("skelgen")
found = PathFinder.find_spec("_core", package and package.submodule_search_locations)
if found is None or found.loader is None:
    sys.exit("skelgen: error: the Python package skelgen is not there; install it again")
core = importlib.util.module_from_spec(found)
found.loader.exec_module(core)
signal.signal(signal.SIGINT, signal.SIG_DFL)  # Python would only look at it after the command
sys.exit(core.run_program([os.fsencode(argument) for argument in sys.argv[1:]]))

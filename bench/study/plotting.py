"""The functions of script/plot_record, which has no .py at its end."""

import importlib.machinery
import importlib.util
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def _load():
    loader = importlib.machinery.SourceFileLoader("plot_record", os.path.join(ROOT, "script", "plot_record"))
    kept, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("plot_record", loader))
    loader.exec_module(module)
    sys.dont_write_bytecode = kept
    return module


plot_record = _load()

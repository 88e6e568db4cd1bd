"""Interlocking trusses in FreeCAD: the workbench of scadgen."""

__all__ = ["__version__"]

#: Version of the workbench; the engine must have the same first two numbers.
__version__ = "0.1.0"

"""scadgen: planar frames as parts that snap into a stable truss."""

__all__ = ["__version__"]

__version__ = "0.1.0"

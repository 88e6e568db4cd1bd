"""Checks: everything that can be proved or measured about a kit."""

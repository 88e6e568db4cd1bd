"""Edge elements and loose parts: what is printed."""

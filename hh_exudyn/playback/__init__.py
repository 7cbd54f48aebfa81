"""Rerun recordings of a run, and pictures of them taken without a screen."""

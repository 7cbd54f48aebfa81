"""Vehicles as frozen descriptions: bodies, couplings and parameters with their source. No Exudyn here."""

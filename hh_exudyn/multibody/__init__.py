"""The only importer of Exudyn: vehicle and track descriptions become a multibody system and are run."""
